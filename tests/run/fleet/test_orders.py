"""Orders to buoys in processes of their own, over their mesh; and a mesh that hears those it has certified only."""

import re
import threading
import time

import pytest

from certificates import certificates
from fleets import differences
from scenarios import small
from shoal.buoy.orderer import Orderer
from shoal.buoy.trust import Trust, key_in
from shoal.buoy.zenoh_mesh import ANY, ZenohMesh, protocol_of
from shoal.core.errors import FleetError
from shoal.run.fleet.run_fleet import Terms, run_fleet

pytest.importorskip("zenoh", reason="the extra fleet is not installed")
SOON = 20.0  # [s] a busy machine may take that long


@pytest.fixture(scope="module")
def configs(tmp_path_factory):
    return certificates(tmp_path_factory.mktemp("certificates"))


def wait_for(nodes, mesh):
    until = time.monotonic() + SOON
    while mesh.alive() < nodes and time.monotonic() < until:
        time.sleep(0.02)
    return mesh.alive()


class TestCertificates:
    """A node without a certificate of the mesh's authority is not heard."""

    def test_who_has_one_is_heard_and_who_has_another_or_none_is_not(self, configs):
        ours, theirs = configs
        meshes = [ZenohMesh("shoal/1", "listener", listen="tls/127.0.0.1:0", config=ours)]
        place = meshes[0].place
        tls = {"listen": "tls/127.0.0.1:0", "connect": [place]}
        meshes += [
            ZenohMesh("shoal/1", "other", **tls, config=theirs),
            ZenohMesh("shoal/1", "none", connect=[place.replace("tls", "tcp")]),
            ZenohMesh("shoal/1", "friend", **tls, config=ours),
        ]
        for mesh in meshes:
            mesh.join()
        listener, *strangers, friend = meshes
        try:
            assert wait_for(2, listener) == 2
            for _ in range(10):
                for stranger in strangers:
                    stranger.publish(b"strange")
                    stranger.order(b"strange")
                time.sleep(0.1)
            friend.publish(b"report")
            friend.order(b"order")
            assert listener.take(SOON) == [b"report"]
            assert listener.orders(SOON) == [b"order"]
            assert (listener.alive(), [each.alive() for each in strangers]) == (2, [1, 1])
        finally:
            for mesh in meshes:
                mesh.close()

    def test_links_go_by_tls_where_there_are_any(self, configs, tmp_path):
        assert (protocol_of(None), protocol_of(configs[0])) == ("tcp", "tls")
        plain = tmp_path / "plain.json5"
        plain.write_text("{ mode: 'client' }")
        assert protocol_of(plain) == "tcp"

    @pytest.mark.parametrize("text", ["", "{", "{ no: 'field of zenoh' }"])
    def test_what_is_no_configuration_is_one_sentence(self, tmp_path, text):
        file = tmp_path / "wrong.json5"
        file.write_text(text)
        with pytest.raises(FleetError, match="is no configuration of zenoh"):
            run_fleet(small(4, 2), Terms(trust=Trust(mesh_config=file)))
        with pytest.raises(FleetError, match="is no configuration of zenoh"):
            protocol_of(tmp_path / "absent.json5")


def test_orders_in_lockstep_are_commands_of_the_scenario_to_the_bit(configs, tmp_path):
    file, answers = tmp_path / "key", []
    ordered, threads, later = threading.Event(), [], []

    def give(place):
        mesh = ZenohMesh(ANY, None, connect=[place], listen="tls/127.0.0.1:0", config=configs[0])
        try:
            giver = Orderer(mesh, place, key_in(file), SOON)
            answers.append(giver.order("hold", agents=[1, 2, 7]))
            answers.append(giver.order("set", {"neighbors": 3}))
            answers.append(giver.order("recall"))
            mesh.order(b"O\0[]" + bytes(32))
        finally:
            mesh.close()
            ordered.set()

    def tell(place):
        threads.append(threading.Thread(target=give, args=(place,)))
        threads[0].start()

    def progress(done, total):
        later.append(done) if ordered.is_set() else None
        if len(later) == 40:
            raise KeyboardInterrupt

    terms = Terms(processes=2, lockstep=True, plain=True, speed=20.0, trust=Trust(file, configs[0]))
    scenario = small(12, 5, {"steps": 9000, "commands": [{"step": 30, "order": "hold", "agents": [3]}]})
    record = run_fleet(scenario, terms, tell=tell, progress=progress)
    threads[0].join()
    assert [(sorted(each.obeyed), each.refused, each.silent) for each in answers] == [
        ([1, 2, 7], {}, []),
        (list(range(12)), {}, []),
        (list(range(12)), {}, []),
    ]
    told = [command for command in record.scenario.commands if command.agents != (3,)]
    assert {(command.step, id) for command in told if command.order == "recall" for id in command.among(12)} == {
        (step, id) for id, step in answers[2].obeyed.items()
    }
    notes = " ".join(record.provenance["notes"])
    assert re.search(rf"ordered by mesh, from step {answers[0].obeyed[1]} on: hold: buoys? 1\b", notes)
    assert " 1 forged" in notes  # by the buoys that it reached, who did not pass it on
    assert differences(record) == []


def test_without_a_key_nobody_obeys(monkeypatch, tmp_path):
    from shoal.run.fleet.processes import Processes

    def progress(done, total):
        crowds[0].mesh.order(b"O\0[]" + bytes(32))

    crowds, enter = [], Processes.__enter__
    monkeypatch.setattr(Processes, "__enter__", lambda self: (crowds.append(self), enter(self))[1])
    record = run_fleet(small(4, 2, {"steps": 20}), Terms(processes=2, lockstep=True, plain=True), progress=progress)
    assert any("none was obeyed: the buoys have no key" in note for note in record.provenance["notes"])
    assert differences(record) == []
