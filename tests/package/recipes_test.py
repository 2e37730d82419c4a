"""The recipe for Debian's packages agrees with what is built."""

import pathlib
import re
import sys
import unittest

source = pathlib.Path(sys.argv[1])
lists = (source / "CMakeLists.txt").read_text()


class Debian(unittest.TestCase):
    """What needs no package to be built."""

    version = re.search(r"project\(Octetra VERSION (\S+)", lists)[1]
    control = (source / "debian/control").read_text()

    def test_version_is_that_of_the_sources(self):
        changelog = (source / "debian/changelog").read_text()
        self.assertEqual(re.match(r"octetra \(([\d.]+)", changelog)[1], self.version)
        named = set(re.findall(r"liboctetra(\d[\d.]*)", self.control))
        self.assertEqual(named, {self.version.rpartition(".")[0]})

    def test_packages_to_build_with_are_those_that_dev_installs(self):
        field = re.search(r"^Build-Depends:\n((?: .*\n)+)", self.control, re.MULTILINE)[1]
        wanted = set(re.findall(r"^ ([\w.+-]+)", field, re.MULTILINE))
        sections = re.split(r"^\[(.+)\]$", (source / "packages.txt").read_text(), flags=re.MULTILINE)
        installed = {name for section, names in zip(sections[1::2], sections[2::2])
                     if section in ("build", "packages") for name in names.split()}
        self.assertLessEqual({name.replace("debhelper-compat", "debhelper") for name in wanted}, installed)
        self.assertNotIn("libtet1.5-dev", wanted)

    def test_licence_is_the_text_of_the_file(self):
        text = (source / "debian/copyright").read_text().partition("License: BSD-3-Clause\n")[2]
        words = [word for word in text.split() if word != "."]
        self.assertEqual(words, (source / "LICENSE").read_text().partition("developers\n")[2].split())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
