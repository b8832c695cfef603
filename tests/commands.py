"""Commands as a user gives them."""

import time

from shoal.cli.main import run_command


def shoal(capsys, *tokens):
    """Run a command; return exit code, stdout and stderr."""
    code = run_command([str(token) for token in tokens])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def wait_until(process, begun):
    """Wait until `begun()`; a process that ends before has failed."""
    while not begun():
        assert process.poll() is None, f"ended with {process.returncode}"
        time.sleep(0.05)
