"""Who prints a help, lists or reads does not wait for the compiler."""

import subprocess
import sys

import pytest

from scenarios import scenario
from shoal.cli.main import app
from shoal.compiler.kernel import why_uncached
from shoal.compiler.late import compiles
from shoal.run.simulate import simulate

SCRIPT = """
import sys
from shoal.cli.main import run_command

for tokens in {commands!r}:
    assert run_command(tokens) == 0, tokens
    assert "numba" not in sys.modules, tokens
"""


def test_without_the_compiler(tmp_path):
    simulate(scenario(changes={"steps": 50}), out=tmp_path / "r")
    verbs = [name for name in app if not name.startswith("-")]
    assert len(verbs) > 15
    commands = [
        ["--help"],
        *([verb, "--help"] for verb in verbs),
        ["presets"],
        ["strategies"],
        ["schema"],
        ["scenario", "bay"],
        ["show", str(tmp_path / "r")],
        ["show", str(tmp_path / "r"), "--json"],
    ]
    subprocess.run([sys.executable, "-c", SCRIPT.format(commands=commands)], check=True, stdout=subprocess.DEVNULL)


BUOY = """
import sys
sys.modules["numba"] = None
import shoal.cli.buoy, shoal.buoy.serve, shoal.buoy.sail, shoal.buoy.mavlink_body
from shoal.buoy.aboard import Aboard
from shoal.buoy.ground import GroundFrame

GroundFrame((5.3, 60.4)).local(5.4, 60.5)
Aboard("oceans2020", [7]).warm()
needless = {"pyproj", "rich", "xml", "scipy", "pandas", "matplotlib", "shoal.tracks", "shoal.run"}
print(*sorted(needless & set(sys.modules)))
"""


def test_a_buoy_on_a_small_computer_imports_what_it_needs_only():
    done = subprocess.run([sys.executable, "-c", BUOY], check=True, stdout=subprocess.PIPE, text=True)
    assert done.stdout == "\n"


WARM = """
import sys
from shoal.cli.main import run_command

assert run_command(["run", "oceans2020", "--steps", "1"]) == 0
assert "numba" in sys.modules
assert not {"numba.np.npyimpl", "scipy", "yaml"} & set(sys.modules)
"""


@pytest.mark.skipif(not compiles() or why_uncached() is not None, reason="machine code is not kept here")
def test_what_is_compiled_already_is_loaded_without_what_compiling_needs():
    simulate(scenario(changes={"steps": 1}))
    subprocess.run([sys.executable, "-c", WARM], check=True, stdout=subprocess.DEVNULL)


LACKING = """
import sys

class Lacking:
    def find_spec(self, name, path=None, target=None):
        if name == {lacking!r}:
            raise ModuleNotFoundError("No module named " + repr(name), name=name)

sys.meta_path.insert(0, Lacking())
sys.argv = ["shoal", "buoy", "oceans2020", "--id", "7", "--body", "simulated"]
from shoal.__main__ import main
main()
"""


@pytest.mark.parametrize(
    ("lacking", "fix"), [("cyclopts", "pip install cyclopts"), ("numba", "`shoal buoy` does without it by --plain")]
)
def test_a_library_that_is_left_out_on_small_computers_is_one_error(lacking, fix):
    done = subprocess.run([sys.executable, "-c", LACKING.format(lacking=lacking)], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 2)
    assert done.stderr.startswith(f"shoal: {lacking}: is not installed, and ")
    assert fix in done.stderr
