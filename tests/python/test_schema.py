"""The JSON Schema of cases, studies and powders, judged by a validator that is not ours."""

import copy
import json
import tomllib
import unittest

from support import ROOT  # first: it tells what is missing

import jsonschema

from vkdose.program import call


def tables(file):
    return tomllib.loads(file.read_text(encoding="utf-8"))


def kind_of(content):
    """None: a table of expected results or a queue."""
    if {"axis", "calibrate", "set", "seeds"} & content.keys():
        return "study"
    if "title" in content:
        return "powder"
    return "case" if {"particles", "base"} & content.keys() else None


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = json.loads(call("manual", "keys", "--schema"))
        cls.study = json.loads(call("manual", "keys", "--study", "--schema"))
        cls.powder = json.loads(call("manual", "keys", "--powder", "--schema"))

    def refused(self, content, schema):
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(content, schema, jsonschema.Draft7Validator)

    def test_all_are_schemas(self):
        for schema in (self.case, self.study, self.powder):
            jsonschema.Draft7Validator.check_schema(schema)

    def test_every_shipped_file_is_valid(self):
        seen = {"case": 0, "study": 0, "powder": 0}
        for file in sorted((ROOT / "cases").rglob("*.toml")):
            content = tables(file)
            kind = kind_of(content)
            if kind is None:
                continue
            with self.subTest(file=file.name):
                jsonschema.validate(content, getattr(self, kind), jsonschema.Draft7Validator)
            seen[kind] += 1
        self.assertGreater(seen["case"], 15)
        self.assertGreater(seen["study"], 10)
        self.assertGreater(seen["powder"], 0)

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
        # Tables of a list by their names, over a base.
        jsonschema.validate({"base": "a.toml", "body": {"gate": {"motion": {"speed_rpm": 3.0}}}}, self.case,
                            jsonschema.Draft7Validator)
        self.refused({"base": "a.toml", "body": {"gate": {"motion": {"speed": 3.0}}}}, self.case)
        self.refused({"base": "mini.toml", "axis": [{"kye": "coil.speed_rpm"}]}, self.study)
        self.refused({"title": "beads", "coil": {"turns": 3}}, self.powder)
        self.refused({"title": "beads", "held": [{"figure": "heap.angle_deg", "fitted": 1}]}, self.powder)

    def test_a_table_of_a_study_may_have_any_key_of_a_case(self):
        content = {"base": "mini.toml", "set": {"coil.speed_rpm": 60}, "axis": [{"key": "seed", "values": [1, 2]}]}
        jsonschema.validate(content, self.study, jsonschema.Draft7Validator)


if __name__ == "__main__":
    unittest.main()
