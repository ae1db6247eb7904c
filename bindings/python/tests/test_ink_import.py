"""Pen recordings in other formats, and the y axis of pen traces."""

import gzip

import numpy as np
import pytest

import calligraphy as cal

#: A heng, a movement in the air and a shu, in an SVC file, whose y points up: an em is 500 / 0.8 = 625 of its units.
SVC = b"""5
1000 5000 70000 1 900 450 1023
1400 5000 70010 1 0 900 511
1400 5400 70020 0 0 900 0
1000 5400 70030 1 2700 900 1
1000 4900 70040 1 2700 900 2
"""


def test_the_content_of_a_file_becomes_traces_in_em_and_seconds():
    read = cal.import_ink(SVC, text="十", set="tablet")
    assert read.format is cal.InkFormat.svc and read.text_used == 1
    (trace,) = read.traces
    assert (trace.character, trace.set) == ("十", "tablet")
    heng, shu = trace.strokes
    assert np.allclose(heng, [[0.18, 0.26, 0.0], [0.82, 0.26, 0.01]])
    assert np.allclose(shu, [[0.18, 0.9, 0.03], [0.18, 0.1, 0.04]])
    assert np.allclose(trace.air[1], [[0.82, 0.9, 0.02]])
    assert trace.stylus[0][:, cal.stylus_columns.index("pressure")].tolist() == [1.0, 511 / 1023]
    assert cal.import_ink(SVC, text="十", set="tablet", y_axis="down").traces == [cal.turn_over(trace)]


def test_a_file_is_read_compressed_or_not_and_its_name_tells_the_character(tmp_path):
    (tmp_path / "十-1.svc").write_bytes(SVC)
    (tmp_path / "packed.svc").write_bytes(gzip.compress(SVC))
    (trace,) = cal.import_ink(tmp_path / "十-1.svc").traces
    assert (trace.character, trace.set) == ("十", "十-1")
    assert cal.import_ink(str(tmp_path / "packed.svc"), name="十-1.svc").traces == [trace]
    with pytest.raises(cal.FormatError, match="packed.svc"):  # without the character
        cal.import_ink(tmp_path / "packed.svc")
    with pytest.raises(cal.FormatError, match="^bytes: "):
        cal.import_ink(gzip.compress(SVC), text="十")
    with pytest.raises(cal.InvalidValue, match="expected one of down, up, got 'left'"):
        cal.import_ink(SVC, text="十", y_axis="left")


def test_writing_shows_where_y_points():
    def written(character):
        lines = [cal.stroke_polyline(stroke) for stroke in cal.built_in_characters()[character].strokes()]
        times = np.cumsum([0.1 for line in lines for _ in line])
        starts = np.cumsum([0, *map(len, lines)])
        return cal.PenTrace(
            character,
            [np.column_stack([line, times[first : first + len(line)]]) for line, first in zip(lines, starts)],
        )

    traces = [written(character) for character in "永和九年"]
    assert cal.recognise_y_axis(traces) is cal.YAxis.down
    assert cal.recognise_y_axis(list(map(cal.turn_over, traces))) is cal.YAxis.up
    assert cal.recognise_y_axis([written("一")]) is None
    assert traces[0] == written("永"), "the traces that were given stay as they are"
