"""Specification of reading KML."""

import pytest

from shoal.tracks.read import read_track
from track_files import DEGREE, refusal, write

STAMPS = [f"2020-01-01T00:0{i}:00Z" for i in range(3)]


class TestKml:
    """gx:Track, or placemarks with a time."""

    def kml(self, folder, *body):
        return write(
            folder,
            "track.kml",
            '<?xml version="1.0" encoding="UTF-8"?>',
            '<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"><Document>',
            *body,
            "</Document></kml>",
        )

    def track(self, name, lat=0.0, stamps=STAMPS):
        """A gx:Track along a parallel."""
        return (
            f"<Placemark><name>{name}</name><gx:Track>",
            *(f"<when>{stamp}</when>" for stamp in stamps),
            *(f"<gx:coord>{0.001 * i} {lat} 0</gx:coord>" for i in range(len(stamps))),
            "</gx:Track></Placemark>",
        )

    def test_a_track_is_read(self, tmp_path):
        track = read_track(self.kml(tmp_path, *self.track("Tug")))
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)

    def test_several_are_told_apart_by_index_and_name(self, tmp_path):
        path = self.kml(tmp_path, "<Folder>", *self.track("Tug"), "</Folder>", *self.track("Ferry", lat=1.0))
        assert "holds 2 tracks, told apart by track" in refusal(path)[1]
        assert read_track(path, track_id="name=Ferry").origin[1] == 1.0
        assert read_track(path, track_id="track=1").origin[1] == 1.0

    def test_parts_of_one_multitrack_are_joined_by_their_name(self, tmp_path):
        later = [stamp.replace("T00", "T01") for stamp in STAMPS]
        first, second = ("\n".join(self.track("", stamps=stamps)[1:-1]) for stamps in (STAMPS, later))
        body = f"<Placemark><name>Trip</name><gx:MultiTrack><gx:Track>{first}</gx:Track><gx:Track>{second}</gx:Track>"
        path = self.kml(tmp_path, body, "</gx:MultiTrack></Placemark>")
        assert len(read_track(path, track_id="name=Trip").time) == 6

    def test_placemarks_with_a_time_are_fixes(self, tmp_path):
        body = (
            f"<Placemark><name>{i}</name><TimeStamp><when>{stamp}</when></TimeStamp>"
            f"<Point><coordinates> {0.001 * i},0,0 </coordinates></Point></Placemark>"
            for i, stamp in enumerate(STAMPS)
        )
        assert read_track(self.kml(tmp_path, *body)).time.tolist() == [0.0, 60.0, 120.0]

    def test_times_and_places_that_do_not_pair_are_refused_with_their_line(self, tmp_path):
        path = self.kml(tmp_path, *self.track("Tug")[:-2], "</gx:Track></Placemark>")
        where, problem, _ = refusal(path)
        assert where.endswith("track.kml:3")
        assert problem == "has 3 times <when> for 2 places <gx:coord>"

    def test_a_line_is_a_plan(self, tmp_path):
        line = "<Placemark><LineString><coordinates>0,0 1,1</coordinates></LineString></Placemark>"
        _, problem, fix = refusal(self.kml(tmp_path, line))
        assert problem == "holds no <gx:Track> and no placemarks with a <TimeStamp>"
        assert "a line or a route has none" in fix

    def test_other_xml_is_refused(self, tmp_path):
        assert "holds no <kml>" in refusal(write(tmp_path, "a.kml", "<gpx/>"))[1]

    def test_a_doctype_is_refused(self, tmp_path):
        assert "DOCTYPE, which KML needs not" in refusal(write(tmp_path, "a.kml", "<!DOCTYPE kml><kml/>"))[1]
