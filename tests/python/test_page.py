"""The blocks of Python on the package's page, run one after another as a reader would."""

import re
import unittest
from pathlib import Path

from support import ROOT, InFolder


class Page(InFolder):
    def test_the_examples_run(self):
        page = (ROOT / "host" / "python" / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), 4)
        names = {}
        for block in blocks:
            exec(compile(block, "README.md", "exec"), names)
        self.assertTrue(Path("out/python/summary.json").is_file())
        self.assertEqual(len(names["members"]), 4)


if __name__ == "__main__":
    unittest.main()
