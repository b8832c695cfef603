"""Every example runs, and the page that quotes it quotes it to the letter."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from scenarios import scenario
from shoal.cli.main import run_command
from shoal.run.simulation import Simulation

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = [file for file in sorted((ROOT / "examples").glob("*.py")) if file.name != "my_strategy.py"]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.name)
def test_the_example_runs(script, tmp_path):
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout


def test_the_sea_of_a_preset_is_what_its_script_makes(tmp_path):
    netcdf = pytest.importorskip("netCDF4", reason="NetCDF files need pip install '.[maritime]'")
    subprocess.run([sys.executable, ROOT / "examples/sea_file.py", tmp_path / "sea.nc"], check=True)
    shipped = ROOT / "src/shoal/scenario/presets/offshore.nc"
    with netcdf.Dataset(tmp_path / "sea.nc") as made, netcdf.Dataset(shipped) as kept:
        assert set(made.variables) == set(kept.variables)
        for name in made.variables:
            np.testing.assert_allclose(made[name][:], kept[name][:], rtol=0, atol=1.01e-3, err_msg=name)


def test_the_example_strategy_runs(tmp_path):
    command = [sys.executable, "-m", "shoal", "run", "oceans2020", "--steps", "2000", "--strategy"]
    done = subprocess.run(
        [*command, ROOT / "examples/my_strategy.py"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "strategy wander" in done.stdout


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow) for name in ("boids", "vicsek")])
def test_the_example_of_named_sums_runs(name):
    """Each is compiled: half a minute."""
    chosen = scenario("oceans2020", {"strategy": {"file": str(ROOT / f"examples/strategies/{name}.py")}})
    simulation = Simulation(chosen)
    frames = simulation.advance(400, every=1)
    assert frames.on_target.any()
    heading = np.array([frames.vx, frames.vy]) / np.maximum(np.hypot(frames.vx, frames.vy), 1e-12)
    order = np.hypot(*heading.mean(axis=2))[200:].mean()  # 1: all head alike; 50 at random: 0.13
    assert order > 0.4


@pytest.mark.parametrize(
    ("page", "example"),
    [("own-strategy.md", "my_strategy.py"), ("figures.md", "figures.py"), ("decide-on-a-buoy.md", "buoys.py")],
)
def test_the_page_quotes_the_example(page, example):
    text = (ROOT / "docs/how-to" / page).read_text(encoding="utf-8")
    assert (ROOT / "examples" / example).read_text(encoding="utf-8") in text


def test_the_commands_and_the_code_of_the_page_on_films_run(tmp_path, monkeypatch, capsys):
    pytest.importorskip("imageio_ffmpeg", reason="films need imageio-ffmpeg: pip install '.[video]'")
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/how-to/film.md").read_text(encoding="utf-8")
    _, commands, *_ = re.findall(r"```sh\n(.*?)```", page, flags=re.DOTALL)
    for line in commands.splitlines():
        assert run_command(shlex.split(line, comments=True)[1:]) == 0, capsys.readouterr().err
    (code,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    exec(code, {})
    assert {file.name for file in tmp_path.iterdir()} == {"swarm.mp4", "links.gif", "still.png", "run", "run.mp4"}


def test_the_code_of_the_page_on_buoys_runs(capsys):
    page = (ROOT / "docs/how-to/decide-on-a-buoy.md").read_text(encoding="utf-8")
    code, *_ = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    exec(code, {})
    assert len(capsys.readouterr().out.split()) == 2


def test_the_code_of_the_page_on_learning_runs():
    pytest.importorskip("pettingzoo", reason="environments need pip install '.[rl]'")
    pytest.importorskip("gymnasium", reason="environments need pip install '.[rl]'")
    page = (ROOT / "docs/how-to/learn.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    agents, swarms = (next(each for each in blocks if kind in each) for kind in ("ParallelEnv(", "VectorEnv("))
    scope = {}
    exec(agents.replace("steps=1000", "steps=20"), scope)
    assert scope["env"].agents == []
    exec(swarms, scope)
    assert f"  # {scope['observations'].shape}" in swarms


@pytest.mark.slow
def test_the_example_that_evolves_gains(tmp_path):
    pytest.importorskip("gymnasium", reason="environments need pip install '.[rl]'")
    script = ROOT / "examples/learning/evolve.py"
    done = subprocess.run([sys.executable, script, "15"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    before, after = map(float, re.findall(r"([\d.]+) (?:before|after)", done.stdout))
    assert after > before
