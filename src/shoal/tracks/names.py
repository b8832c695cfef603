"""What columns are called: time, place, and whose fix it is."""

import re
from collections.abc import Sequence

TIME_NAMES = (
    "time", "timestamp", "tstamp", "datetime", "basedatetime", "timeutc", "utctime", "timestamputc", "utctimestamp",
    "datetimeutc", "utcdatetime", "msgtime", "msgt", "gpstime", "fixtime", "positiontime", "timeposition", "obstime",
    "recordedat", "createdat", "receivedat", "ts", "epoch", "unixtime", "unixtimestamp", "posixtime", "timestampms",
    "dtposutc", "utc", "date",
)  # fmt: skip
LAT_NAMES = ("lat", "latitude", "latdeg", "latitudedeg", "latdd", "gpslat", "gpslatitude", "locationlat", "ylat")
LON_NAMES = (
    "lon", "longitude", "lng", "long", "londeg", "longitudedeg", "londd", "gpslon", "gpslongitude", "gpslng",
    "locationlong", "locationlon", "locationlng", "xlon",
)  # fmt: skip
TIME_LIKE = r"(?!.*(eta|interval|step|zone|dwell|travel|elapsed)).*(time|timestamp|datetime)(utc|gmt|z)?"
LAT_LIKE = r"(?!.*(err|std|acc|var|min|max|unc))(lat.*|.*latitude)"
LON_LIKE = r"(?!.*(err|std|acc|var|min|max|unc))(lon.*|lng.*|.*longitude)"
HEMISPHERES = {  # columns that say on which side a latitude or a longitude without a sign lies
    "lat": re.compile(r"ns(ind\w*|hemi\w*)?|(lat|latitude)(ns|dir|direction|ref|hemi\w*|ind\w*|side)"),
    "lon": re.compile(r"ew(ind\w*|hemi\w*)?|(lon|long|longitude)(ew|dir|direction|ref|hemi\w*|ind\w*|side)"),
}
DATE_NAMES = ("date", "dateutc", "utcdate", "ymd", "gpsdate")
CLOCK_NAMES = ("time", "timeutc", "utctime", "clock", "hms", "gpstime", "utc")
PARTS = ("year", "month", "day", "hour", "minute", "second")
PART_NAMES = {"yy": "year", "yyyy": "year", "mm": "month", "dd": "day", "hh": "hour", "min": "minute", "sec": "second"}

CRAFT = (
    "vessel|ship|boat|yacht|craft|buoy|drifter|glider|float|platform|device|tracker|asset|vehicle|animal|individual"
    "|drone|uav|usv|auv|rov|unit|transponder|beacon|sensor|station|user|entity|target|tag|collar|object|person|team"
)
JOURNEY = "track|trajectory|traj|trip|voyage|deployment|mission|journey"
NUMBER = "id|ids|code|no|nr|num|number|identifier|key|serial|serialnumber|ident"
RANKS = tuple(
    re.compile(pattern)
    for pattern in (
        r".*mmsi",
        r".*imei",
        rf"({CRAFT})(local)?({NUMBER})|wmo({NUMBER})?|ptt({NUMBER})?|argos({NUMBER})?|esn|serial(no|number)?",
        rf"({CRAFT})s?",
        rf"({JOURNEY})(local)?({NUMBER})?",
        r"imo(no|number)?|.*callsign",
        r"id|uid|fid|ident|identifier|.*uuid|.*guid|key",
        rf"({CRAFT}|{JOURNEY})?(name|label|title)",
    )
)
JOURNEYS = 4  # from this rank on: several may be parts of one trip
MAY_NUMBER_THE_ROWS = len(RANKS) - 2  # from this rank on: an id or a name may be that of the fix
OBJECTS = ("objectid", "trackid", "key")  # and so may these

MOTION = re.compile(r"sog|cog|course|heading|hdg|bearing|speed|vel|rot|turn")
ATTRIBUTE = re.compile(
    r"status|type|class|cargo|length|width|beam|draft|draught"
    r"|depth|alt|ele|height|sat|dop|quality|qc|flag|fix|battery|batt|volt|temp|press|sal|wind|wave|source|provider"
    r"|zone|crs|unit|message|msg|version|time|date|hour|minute|second|year|month|day|seq|index|count|segment|seg|leg|mode"
    r"|state|destination|eta|flagstate|country|note|comment|remark|accuracy|error|distance|rssi|snr|channel"
)


def plain(name: str) -> str:
    """A column's name without case, unit, space or sign: 'Latitude (deg)' and 'latitude' are the same."""
    return re.sub(r"[^a-z0-9]", "", re.sub(r"[(\[{].*?[)\]}]", "", name).lower())


def find(columns: Sequence[str], names: Sequence[str], like: str = "") -> int | None:
    """The index of the first of `names` that is a column, or else of the column that matches `like`."""
    there = [plain(column) for column in columns]
    exact = next((there.index(name) for name in names if name in there), None)
    if exact is not None or not like:
        return exact
    return next((i for i, name in enumerate(there) if re.fullmatch(like, name)), None)


def rank(column: str) -> int | None:
    """How surely a column says whose fix it is: 0 best, None if it does not seem to."""
    name = plain(column)
    return next((i for i, pattern in enumerate(RANKS) if pattern.fullmatch(name)), None)


def is_certain(column: str) -> bool:
    """Whether two values are two tracks, however few fixes each has."""
    number = rank(column)
    return number is not None and number < MAY_NUMBER_THE_ROWS and plain(column) not in OBJECTS


def is_motion(column: str) -> bool:
    """Whether a column seems to tell course or speed, which go with where a vehicle is."""
    return rank(column) is None and MOTION.search(plain(column)) is not None


def is_attribute(column: str) -> bool:
    """Whether a column seems to tell something else, such as a status."""
    return is_motion(column) or ATTRIBUTE.search(plain(column)) is not None
