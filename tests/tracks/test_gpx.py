"""Specification of reading GPX."""

import pytest

from shoal.tracks.read import read_track
from track_files import DEGREE, refusal, write


class TestGpx:
    """GPX 1.0 and 1.1, tracks only."""

    POINTS = ('<trkpt lat="0" lon="0"><time>2020-01-01T00:00:00Z</time></trkpt>',
              '<trkpt lat="0" lon="0.001"><ele>3</ele><time>2020-01-01T00:01:00Z</time></trkpt>',
              '<trkpt lat="0" lon="0.002"><time>2020-01-01T00:02:00Z</time></trkpt>')  # fmt: skip

    def gpx(self, folder, *body, version="1/1"):
        return write(
            folder,
            "track.gpx",
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<gpx xmlns="http://www.topografix.com/GPX/{version}">',
            *body,
            "</gpx>",
        )

    def one(self, *points, name=""):
        return (f"<trk><name>{name}</name><trkseg>", *points, "</trkseg></trk>")

    @pytest.mark.parametrize("version", ["1/0", "1/1"])
    def test_both_versions_are_read(self, tmp_path, version):
        track = read_track(self.gpx(tmp_path, *self.one(*self.POINTS), version=version))
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)
        assert track.notes == ()

    def test_a_namespace_prefix_changes_nothing(self, tmp_path):
        text = self.gpx(tmp_path, *self.one(*self.POINTS)).read_text()
        prefixed = text.replace("</", "</g:").replace("<t", "<g:t").replace("<gpx xmlns", "<g:gpx xmlns:g")
        prefixed = prefixed.replace("<name", "<g:name").replace("<ele", "<g:ele")
        assert len(read_track(write(tmp_path, "prefixed.gpx", prefixed)).time) == 3

    def test_segments_follow_one_another(self, tmp_path):
        body = self.one(self.POINTS[0], "</trkseg><trkseg>", *self.POINTS[1:])
        assert len(read_track(self.gpx(tmp_path, *body)).time) == 3

    def test_the_name_chooses_a_track(self, tmp_path):
        body = self.one(*self.POINTS, name="Ferry 1") + self.one(*self.POINTS[:2], name="Tug")
        assert len(read_track(self.gpx(tmp_path, *body), track_id="name=Tug").time) == 2

    def test_the_index_chooses_a_track(self, tmp_path):
        body = self.one(*self.POINTS) + self.one(*self.POINTS[:2])
        assert len(read_track(self.gpx(tmp_path, *body), track_id="track=1").time) == 2

    def test_several_tracks_without_a_choice_are_refused_with_an_example(self, tmp_path):
        body = self.one(*self.POINTS[:2]) + self.one(*self.POINTS)
        _, problem, fix = refusal(self.gpx(tmp_path, *body))
        assert "holds 2 tracks" in problem
        assert "--track-id track=1 has the most fixes, 3" in fix

    def test_tracks_of_one_name_are_parts_of_one_trip(self, tmp_path):
        body = self.one(*self.POINTS[:2], name="Log") + self.one(self.POINTS[2], name="Log")
        assert len(read_track(self.gpx(tmp_path, *body), track_id="name=Log").time) == 3

    @pytest.mark.parametrize("track_id", ["name=Log*", "all"])
    def test_a_star_or_all_joins_tracks(self, tmp_path, track_id):
        body = self.one(*self.POINTS[:2], name="Log") + self.one(self.POINTS[2], name="Log #2")
        path = self.gpx(tmp_path, *body)
        assert "--track-id all joins them" in refusal(path)[2]
        assert len(read_track(path, track_id=track_id).time) == 3

    def test_a_point_without_time_is_dropped_and_counted(self, tmp_path):
        track = read_track(self.gpx(tmp_path, *self.one('<trkpt lat="0" lon="9"/>', *self.POINTS)))
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.notes == ("Fixes dropped because the file marks them missing: 1.",)

    def test_points_without_any_time_are_a_plan(self, tmp_path):
        path = self.gpx(tmp_path, *self.one('<trkpt lat="0" lon="0"/>', '<trkpt lat="0" lon="1"/>'))
        _, problem, fix = refusal(path)
        assert problem == "no fix has a time"
        assert "planned route" in fix

    def test_an_unknown_name_is_answered_with_the_nearest(self, tmp_path):
        path = self.gpx(tmp_path, *self.one(*self.POINTS, name="Ferry"))
        assert "name=Ferry" in refusal(path, track_id="name=Fery")[2]

    def test_an_unknown_column_is_answered_with_track_and_name(self, tmp_path):
        path = self.gpx(tmp_path, *self.one(*self.POINTS))
        assert "it has track, name" in refusal(path, track_id="mmsi=1")[1]

    @pytest.mark.parametrize(
        ("point", "problem"),
        [
            ('<trkpt lat="0" lon="0"><time>noon</time></trkpt>', "time 'noon' cannot be read"),
            ('<trkpt lat="0" lon="x"><time>2021-01-01T00:00:00Z</time></trkpt>', "lon 'x' is not"),
            ('<trkpt lat="99" lon="0"><time>2021-01-01T00:00:00Z</time></trkpt>', "lat 99 is out"),
        ],
    )
    def test_a_bad_point_is_named_with_its_line(self, tmp_path, point, problem):
        where, found, _ = refusal(self.gpx(tmp_path, *self.one(self.POINTS[0], point)))
        assert where.endswith("track.gpx:5")
        assert found.startswith(problem)

    def test_a_doctype_is_refused_before_its_entities_can_act(self, tmp_path):
        bomb = '<!DOCTYPE gpx [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><gpx>&b;</gpx>'
        where, problem, fix = refusal(write(tmp_path, "bomb.gpx", '<?xml version="1.0"?>', bomb))
        assert where.endswith("bomb.gpx:2")
        assert "DOCTYPE" in problem
        assert fix == "remove it"

    def test_an_entity_without_a_doctype_is_no_xml(self, tmp_path):
        assert "is not XML" in refusal(write(tmp_path, "e.gpx", "<gpx>&b;</gpx>"))[1]

    def test_broken_xml_is_named_with_its_line(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "broken.gpx", "<gpx>", "<trk>", "</gpx>"))
        assert where.endswith("broken.gpx:3")
        assert "is not XML" in problem

    @pytest.mark.parametrize("body", ["<rte><rtept lat='0' lon='0'/></rte>", ""])
    def test_a_file_without_a_track_is_refused(self, tmp_path, body):
        assert "holds no <trk>" in refusal(self.gpx(tmp_path, body))[1]

    def test_other_xml_is_refused(self, tmp_path):
        assert "holds no <trk>" in refusal(write(tmp_path, "a.gpx", "<kml><trk/></kml>"))[1]

    def test_a_track_without_points_holds_no_fixes(self, tmp_path):
        assert refusal(self.gpx(tmp_path, "<trk/>"))[1] == "holds no fixes"
