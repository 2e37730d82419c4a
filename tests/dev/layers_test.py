"""Every layer is built and tested with sanitizers, by ./dev test --sanitized or by ./dev campaign nightly."""

import json
import pathlib
import re
import unittest

root = pathlib.Path(__file__).resolve().parent.parent.parent

# Layers that the preset asan-ubsan builds always; those built with OCTETRA_CLI in the nightly run;
# and those never built.
ALWAYS = {"core", "reference", "quality", "distributed", "verify"}
AT_NIGHT = {"generator"}
NEVER = {
    "dolfinx": "DOLFINx is not built with sanitizers, and its objects cross the interface",
    "petsc": "PETSc is not built with sanitizers, and its objects cross the interface",
}
# The option required to build a layer.
OPTION_OF = {"generator": "OCTETRA_CLI", "dolfinx": "OCTETRA_DOLFINX", "petsc": "OCTETRA_PETSC"}


def layers():
    return {name for path in root.rglob("CMakeLists.txt") if "build" not in path.relative_to(root).parts
            for name in re.findall(r"^octetra_layer\((\w+)", path.read_text(), re.MULTILINE)}


def preset():
    presets = json.loads((root / "CMakePresets.json").read_text())["configurePresets"]
    return next(each["cacheVariables"] for each in presets if each["name"] == "asan-ubsan")


class Layers(unittest.TestCase):
    def test_are_each_in_one_list(self):
        self.assertEqual(sorted([*ALWAYS, *AT_NIGHT, *NEVER]), sorted(layers()))

    def test_are_built_as_listed(self):
        off = {name for name, value in preset().items() if value == "OFF"}
        at_night = off - set(re.findall(r"-D(OCTETRA_\w+)=ON", (root / "tools/dev/campaign/nightly.sh").read_text()))
        for name in layers():
            option = OPTION_OF.get(name, f"OCTETRA_{name.upper()}")
            self.assertEqual(option in off, name not in ALWAYS, name)
            self.assertEqual(option in at_night, name in NEVER, name)


if __name__ == "__main__":
    unittest.main()
