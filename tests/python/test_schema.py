"""The JSON Schema of cases and studies, judged by a validator that is not ours."""

import copy
import json
import tomllib
import unittest

from support import ROOT  # first: it tells what is missing

import jsonschema

from vkdose.program import call


def tables(file):
    return tomllib.loads(file.read_text(encoding="utf-8"))


def is_study(content):
    return bool({"axis", "calibrate", "set", "seeds"} & content.keys())


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = json.loads(call("manual", "keys", "--schema"))
        cls.study = json.loads(call("manual", "keys", "--study", "--schema"))

    def refused(self, content, schema):
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(content, schema, jsonschema.Draft7Validator)

    def test_both_are_schemas(self):
        for schema in (self.case, self.study):
            jsonschema.Draft7Validator.check_schema(schema)

    def test_every_shipped_file_is_valid(self):
        seen = {"case": 0, "study": 0}
        for file in sorted((ROOT / "cases").rglob("*.toml")):
            content = tables(file)
            if not is_study(content) and not {"particles", "base"} & content.keys():
                continue  # a table of expected results
            kind = "study" if is_study(content) else "case"
            with self.subTest(file=file.name):
                jsonschema.validate(content, getattr(self, kind), jsonschema.Draft7Validator)
            seen[kind] += 1
        self.assertGreater(seen["case"], 15)
        self.assertGreater(seen["study"], 10)

    def test_slips_are_refused(self):
        good = tables(ROOT / "cases" / "mini.toml")
        jsonschema.validate(good, self.case, jsonschema.Draft7Validator)
        for path, value in {
            ("coil", "speed"): 60,  # no such key
            ("coil", "speed_rpm"): "60",  # not a number
            ("contact", "k"): 0,  # must be positive
            ("seed",): 1.5,  # must be whole
            ("boundaries",): "box",  # none of the words
            ("gravity",): [0, -9.81],  # must have three numbers
            ("contact", "wall", "frictoin"): 0.5,
        }.items():
            content = copy.deepcopy(good)
            table = content
            for name in path[:-1]:
                table = table.setdefault(name, {})
            table[path[-1]] = value
            with self.subTest(key=".".join(path)):
                self.refused(content, self.case)
        self.refused({"base": "mini.toml", "axis": [{"kye": "coil.speed_rpm"}]}, self.study)

    def test_a_table_of_a_study_may_have_any_key_of_a_case(self):
        content = {"base": "mini.toml", "set": {"coil.speed_rpm": 60}, "axis": [{"key": "seed", "values": [1, 2]}]}
        jsonschema.validate(content, self.study, jsonschema.Draft7Validator)


if __name__ == "__main__":
    unittest.main()
