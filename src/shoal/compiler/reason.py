"""Why the compiler refuses a function, in one line of the pages that it writes."""

import re

_TELLS = "rror|nknown|not defined|resolve|nvalid|No implementation"
_SILENT = "Failed in nopython mode|Rejected as|^During|^File "


def reason_in(compiler_text: str) -> str:
    """The line that says most, without the types of all arguments."""
    lines = [line.strip() for line in compiler_text.splitlines() if line.strip()]
    saying = [line for line in lines if not re.search(_SILENT, line)] or lines
    reason = next((line for line in reversed(saying) if re.search(_TELLS, line)), saying[0])
    return re.sub(r"(of type \w+)\(.*", r"\1", reason)
