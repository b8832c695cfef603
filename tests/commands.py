"""Commands as a user gives them."""

from shoal.cli.main import run_command


def shoal(capsys, *tokens):
    """Run a command; return exit code, stdout and stderr."""
    code = run_command([str(token) for token in tokens])
    captured = capsys.readouterr()
    return code, captured.out, captured.err
