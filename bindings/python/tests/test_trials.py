"""Trade-offs and imports from Python: results agree with those of C++."""

import pickle

import numpy as np
import pytest

import calligraphy as cal

YONG = cal.built_in_characters()["永"]


def test_a_wider_grid_costs_bytes_and_halves_the_error():
    rows = cal.coordinate_width_tradeoff([YONG])
    assert rows["bits"].tolist() == list(range(4, 17))
    assert (np.diff(rows["bytes"]) > 0).all() and (np.diff(rows["step"]) < 0).all()
    assert rows["max_error"][-1] < rows["max_error"][0] / 1000
    assert (pickle.loads(pickle.dumps(rows)) == rows).all()


def test_a_faster_servo_permits_stiffer_paper():
    table = slow, fast = cal.servo_rate_tradeoff([cal.built_in_characters()["一"]], [500.0, 1000.0], seeds=1)
    assert table["rate"].tolist() == [500.0, 1000.0] and table["stable"].dtype == bool
    assert fast["held_stiffness"] > slow["held_stiffness"] > 0
    assert fast["written"] == 1.0
    with pytest.raises(cal.InvalidValue):
        cal.servo_rate_tradeoff([YONG], seeds=0)


def test_the_import_report_accounts_for_the_source(tmp_path):
    (tmp_path / "十.json").write_text('{"medians":[[[100,400],[900,400]],[[512,800],[512,0]]]}', encoding="utf-8")
    (tmp_path / "一.json").write_text('{"medians":[[[100,400],[900,400]]]}', encoding="utf-8")
    (tmp_path / "notes.txt").write_text("none", encoding="utf-8")
    characters, report = cal.import_characters(tmp_path, threads=1)
    assert report["kind"] == "hanzi-writer-data"
    assert (report["characters"], report["strokes"]) == (2, 3) == (len(characters), sum(report["ids_used"]))
    assert report["within"]["error"].tolist() == [0.01, 0.02, 0.04] and report["within"]["characters"][0] == 2
    worst = report["worst"]
    assert set(zip(worst["code"].tolist(), worst["stroke"].tolist())) == {("一", 1), ("十", 1), ("十", 2)}
    assert (worst["error"] < 0.005).all() and [path for path, _ in report["skipped"]] == ["notes.txt"]
    assert len(report["measures"]) == 0
    _, report = cal.import_characters(tmp_path, threads=1, report=True)
    measures = report["measures"]
    assert measures["id"].tolist() == [1, 1, 2] and report["crossings"] == (1, 1)
    assert np.allclose(measures["source_length"], 800 / 1024) and (measures["frechet"] < 0.005).all()
    assert not measures["backward"].any() and not measures["false_corners"].any()
    only, report = cal.import_characters(tmp_path, only="一")
    assert [character.code for character in only] == ["一"] and report["characters"] == 1
    (tmp_path / "二.json").write_text("{", encoding="utf-8")
    _, report = cal.import_characters(tmp_path)
    assert [path for path, _ in report["unusable"]] == ["二.json"] and report["characters"] == 2
    with pytest.raises(cal.FormatError, match="二.json"):
        cal.import_characters(tmp_path, strict=True)


def test_an_import_says_which_stroke_orders_it_corrected(tmp_path):
    # Of 冉, whose third stroke begins at 392,447 (data/order_corrections.tsv).
    medians = "[[[200,700],[200,0]],[[200,700],[800,700]],[[392,447],[900,447]],[[512,800],[512,100]],[[100,300],[900,300]]]"
    (tmp_path / "冉.json").write_text(f'{{"medians":{medians}}}', encoding="utf-8")
    characters, report = cal.import_characters(tmp_path)
    assert report["corrected"] == [("冉", "the shu before the heng")]
    assert characters["冉"].stroke_ids.tolist() == [2, 1, 2, 1, 1]
    characters, report = cal.import_characters(tmp_path, corrections=False)
    assert report["corrected"] == [] and characters["冉"].stroke_ids.tolist() == [2, 1, 1, 2, 1]
