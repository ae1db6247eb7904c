"""Tradeoffs, imports, verdicts, trackers and controllers from Python: what crosses the boundary is what C++ has."""

import pickle
import xml.etree.ElementTree

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")
YONG = cal.built_in_characters()["永"]


def is_svg(text):
    return xml.etree.ElementTree.fromstring(text).tag == "{http://www.w3.org/2000/svg}svg"


needs_gnuplot = pytest.mark.skipif(not cal.gnuplot_available(), reason="gnuplot is not installed")


def recorded():
    page = cal.lay_out([YONG])[0]
    options = cal.SessionOptions(
        device=PROFILE, renderer=cal.RendererOptions.for_device(PROFILE.capabilities), skill=cal.WriterSkill.skilled()
    )
    return page, cal.write_page(page, options)


def test_a_wider_grid_costs_bytes_and_halves_the_error():
    rows = cal.coordinate_width_tradeoff([YONG])
    assert [row.bits for row in rows] == list(range(4, 17))
    assert (np.diff([row.bytes for row in rows]) > 0).all()
    assert (np.diff([row.step for row in rows]) < 0).all()
    assert rows[-1].max_error < rows[0].max_error / 1000
    assert pickle.loads(pickle.dumps(rows[3])) == rows[3]


def test_a_character_on_a_grid_keeps_its_strokes():
    coarse = cal.with_coordinate_width(YONG, 4)
    moved = np.abs(np.asarray(coarse.control_points) - np.asarray(YONG.control_points)).max()
    assert 0 < moved <= 0.5 / 15 + 1e-12
    with pytest.raises(cal.InvalidValue, match="33"):
        cal.with_coordinate_width(YONG, 33)


def test_a_faster_servo_bears_a_stiffer_paper():
    slow, fast = cal.servo_rate_tradeoff([cal.built_in_characters()["一"]], [500.0, 1000.0], seeds=1)
    assert (slow.rate, fast.rate) == (500.0, 1000.0)
    assert fast.held_stiffness > slow.held_stiffness > 0
    assert fast.written == 1.0
    with pytest.raises(cal.InvalidValue):
        cal.servo_rate_tradeoff([YONG], seeds=0)


@needs_gnuplot
def test_plots_are_pictures():
    page, recording = recorded()
    assert is_svg(cal.force_plot(recording, 0, "永"))
    assert is_svg(cal.coordinate_width_tradeoff_plot(cal.coordinate_width_tradeoff([YONG])))
    with pytest.raises(cal.InvalidValue):
        cal.force_plot(recording, 7, "none")
    with pytest.raises(cal.InvalidValue):
        cal.servo_rate_tradeoff_plot([])


def test_a_verdict_names_the_stroke_that_was_written_backwards():
    page, recording = recorded()
    paths = cal.pen_paths(recording, page.characters[0].placement)
    right = cal.match_strokes(YONG, paths)
    assert [stroke.stroke for stroke in right.drawn] == list(range(len(YONG.strokes())))
    assert right.remarks == [] and right.count(cal.StrokeRemarkKind.direction) == 0
    turned = [*paths[:-1], paths[-1][::-1]]
    match = cal.match_strokes(YONG, turned)
    assert match.drawn[-1].direction == cal.WritingDirection.backwards
    assert match.count(cal.StrokeRemarkKind.direction) == 1 and match.remarks[0].stroke == len(paths) - 1
    assert pickle.loads(pickle.dumps(match)) == match
    assert is_svg(cal.replay_picture(YONG, turned, match, paths, "永"))
    with pytest.raises(cal.InvalidValue):
        cal.replay_picture(YONG, turned[:-1], match, paths, "永")
    with pytest.raises(cal.InvalidValue, match="paths"):
        cal.match_strokes(YONG, [np.zeros((3, 3))])


def test_the_paths_of_a_trace_are_its_pen_downs():
    line = np.column_stack([np.linspace(0.1, 0.9, 20), np.full(20, 0.5), np.linspace(0, 1, 20)])
    (path,) = cal.pen_paths(cal.PenTrace("一", [line]))
    assert (path == line[:, :2]).all()


def test_an_import_tells_what_became_of_the_source(tmp_path):
    (tmp_path / "十.json").write_text('{"medians":[[[100,400],[900,400]],[[512,800],[512,0]]]}', encoding="utf-8")
    (tmp_path / "一.json").write_text('{"medians":[[[100,400],[900,400]]]}', encoding="utf-8")
    (tmp_path / "notes.txt").write_text("none", encoding="utf-8")
    imported = cal.import_characters(tmp_path, threads=1)
    report = imported.report
    assert report.kind == cal.SourceKind.hanzi_writer_data
    assert (report.characters, report.strokes) == (2, 3) == (len(imported.list), sum(report.ids_used))
    assert [count.error for count in report.within] == [0.005, 0.01, 0.02]
    assert report.within[0].characters == 2 and len(report.worst) == 3
    assert pickle.loads(pickle.dumps(report)) == report
    only = cal.import_characters(tmp_path, only="一")
    assert [character.code for character in only.list.characters] == ["一"]
    assert only.report.characters == 1
    (tmp_path / "二.json").write_text("{", encoding="utf-8")
    with pytest.raises(cal.FormatError, match="二.json"):
        cal.import_characters(tmp_path)


def test_a_tracker_finds_what_every_element_asked_finds():
    placed = cal.lay_out([YONG])[0].characters[0]
    stroke = max(placed.character.strokes(), key=lambda each: len(cal.place_elements(each, placed.placement)))
    elements = cal.place_elements(stroke, placed.placement)
    assert len(elements) > 1
    tracker = cal.StrokeTracker(elements)
    way = np.concatenate([element.point(np.linspace(0, 1, 40)) for element in elements]) + [1e-3, 2e-3]
    answers = np.array([cal.nearest_point(element, way).distance for element in elements])
    del elements
    for query, distances in zip(way, answers.T):
        found = tracker.update(query)
        assert found.certified and found.distance == pytest.approx(distances.min(), abs=1e-12)
        assert np.linalg.norm(found.point - query) == pytest.approx(found.distance)
    assert not tracker.update([np.nan, 0.0]).certified
    with pytest.raises(cal.InvalidValue, match="at most 5"):
        cal.StrokeTracker([cal.StrokeElement([[0, 0], [1, 1]])] * 6)


def test_a_passivity_controller_damps_what_a_sampled_spring_adds():
    def swing(damping):
        controller = cal.PassivityController(cal.PassivityOptions(max_damping=damping), 1e-3)
        place, speed = 1e-3, 0.0  # 45 g on 20 kN/m at 1 kHz, which sampling drives apart
        for _ in range(300):
            wanted = (0.0, 0.0, -2e4 * place)
            force = controller.next((0.0, 0.0, place), wanted)
            controller.sent(force)
            for _ in range(10):
                speed += force[2] / 0.045 * 1e-4
                place += speed * 1e-4
        return abs(place), controller

    loose, off = swing(0.0)
    held, on = swing(cal.PassivityController.usable_damping(0.045, 1e-3, 0))
    assert loose > 1.0 and held < loose / 100
    assert off.energy_given > on.energy_given and on.damping.shape == (3,)
    assert on.max_force == np.inf
    on.restart()
    assert on.energy_given == 0.0
    with pytest.raises(cal.InvalidValue, match="delay"):
        cal.PassivityController(cal.PassivityOptions(delay=16), 1e-3)
