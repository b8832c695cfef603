"""An XML file as a tree of elements that know their line."""

from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

from shoal.core.errors import TrackError


def xml_tree(path: Path, kind: str) -> ElementTree.Element:
    """Return the tree, tags without namespace, each element with its line as attribute `line`.

    Raises
    ------
    TrackError : it is not XML, or has a DOCTYPE
    """
    builder = ElementTree.TreeBuilder()
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        builder.start(tag.rpartition(":")[2], {**attributes, "line": str(parser.CurrentLineNumber)})

    def end(tag: str) -> None:
        builder.end(tag.rpartition(":")[2])

    def refuse_doctype(*_: object) -> None:  # it can define entities: bombs, other files
        raise TrackError(f"{path}:{parser.CurrentLineNumber}", f"has a DOCTYPE, which {kind} needs not", "remove it")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse_doctype
    try:
        with path.open("rb") as file:
            parser.ParseFile(file)
    except (expat.ExpatError, ValueError) as error:
        if isinstance(error, TrackError):
            raise
        line = getattr(error, "lineno", 1)
        said = expat.ErrorString(error.code) if isinstance(error, expat.ExpatError) else error
        raise TrackError(f"{path}:{line}", f"is not XML ({said})", "export the track again") from error
    return builder.close()
