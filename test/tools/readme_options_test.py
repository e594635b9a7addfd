#!/usr/bin/python3
"""The README's section on a program names the options that its --help names.

Usage: readme_options_test.py FOLDER_OF_PROGRAMS PROGRAM...
"""

import os
import re
import subprocess
import sys
import unittest

README = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "README.md")
FOLDER = sys.argv[1]
PROGRAMS = sys.argv[2:]


def section_of(program):
    """Text below the heading of the program, up to the next heading."""
    with open(README) as readme:
        parts = re.split(r"^#+ ", readme.read(), flags=re.MULTILINE)
    return next((part for part in parts if part.startswith("`%s" % program)), "")


def options_of(program):
    text = subprocess.run([os.path.join(FOLDER, program), "--help"], check=True,
                          stdout=subprocess.PIPE, universal_newlines=True).stdout
    return set(re.findall(r"^\s+(?:-\w,)?(--[a-z-]+)", text, flags=re.MULTILINE)) - {"--help"}


class ReadmeOptions(unittest.TestCase):
    def test_every_option_is_explained_where_the_program_is(self):
        for program in PROGRAMS:
            section = section_of(program)
            self.assertTrue(section, program + " has no section")
            for option in options_of(program):
                self.assertIn(option, section, program)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
