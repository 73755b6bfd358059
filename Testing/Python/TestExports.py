# What one library takes of another is exported: on Linux all symbols are seen, elsewhere not.
import os
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def exported():
    """The names of exported functions and classes, as the headers have them."""
    functions, classes = set(), set()
    for header in [*SOURCE.glob("Filters/**/*.h"), *SOURCE.glob("Rendering/**/*.h")]:
        text = header.read_text()
        classes.update(re.findall(r"(?:class|struct)\s+VTK\w+_EXPORT\s+(\w+)", text))
        functions.update(re.findall(r"VTK\w+_EXPORT\s[^;{(]*?(\w+)\(", text))
    return functions, classes


def taken(library):
    """The symbols of the engine that a library takes of others, as nm writes them."""
    lines = subprocess.run(["nm", "-DC", "--undefined-only", library], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    return [line.split(" U ", 1)[1] for line in lines if re.search(r" U (.* for )?svo::", line)]


class Exports(unittest.TestCase):
    def test_what_libraries_take_of_each_other_is_exported(self):
        functions, classes = exported()
        libraries = sorted(pathlib.Path(os.environ["VTKSVO_LIBRARIES"]).glob("libvtkSVO*.so"))
        self.assertGreater(len(libraries), 3)
        symbols = {symbol for library in libraries for symbol in taken(library)}
        self.assertGreater(len(symbols), 10)
        missing = []
        for symbol in sorted(symbols):
            path = re.search(r"svo::([\w:~]+)", symbol).group(1).split("::")
            if path[0] not in classes and not (len(path) == 1 and path[0] in functions):
                missing.append(symbol)
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
