"""The blocks of Python on the package's page, run one after another as a reader would."""

import unittest
from pathlib import Path

from support import InFolder, run_examples


class Page(InFolder):
    def test_the_examples_run(self):
        blocks, names = run_examples(inside=False)
        self.assertGreaterEqual(blocks, 4)
        self.assertTrue(Path("out/python/summary.json").is_file())
        self.assertEqual(len(names["members"]), 4)


if __name__ == "__main__":
    unittest.main()
