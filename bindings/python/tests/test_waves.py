"""Waves, and their comparison."""

import pytest

import motion_rtl as mr


def written(path, ticks, period=10):
    model = mr.Model("enable_counter", width=8)
    model["period"] = period
    model.waves(path)
    model.step(ticks)
    return model.finish_waves()


def test_waves_are_written_from_a_tick_to_another(tmp_path):
    model = mr.Model("enable_counter", width=8)
    model["period"] = 10
    model.step(1_000)
    path = tmp_path / "new" / "counter.vcd"
    model.waves(path)
    model.step(500)
    assert not path.exists()
    assert model.finish_waves() == [path, path.with_suffix(".gtkw")]
    assert path.exists() and path.with_suffix(".gtkw").exists()
    assert model.finish_waves() == []
    assert "#1000" in path.read_text()


def test_waves_of_both_formats_are_equal(tmp_path):
    vcd, fst = tmp_path / "a.vcd", tmp_path / "a.fst"
    written(vcd, 300)
    written(fst, 300)
    report = mr.compare(vcd, fst)
    assert report and report.equal and report.same_length
    fields = report.as_dict()
    assert fields["ticks"] == 300 and fields["moved"] > 0 and fields["differences"] == []
    assert repr(report).startswith("<Report equal, 300 ticks, ")


def test_a_difference_is_found(tmp_path):
    golden, other = str(tmp_path / "a.vcd"), str(tmp_path / "b.vcd")
    written(golden, 300)
    written(other, 300, period=11)
    report = mr.compare(golden, other)
    assert not report and not report.equal
    first = report.as_dict()["first"]
    assert first["tick"] == 0 and "period" in str(report)
    assert "not equal" in repr(report)
    with pytest.raises(ValueError, match="all of them are left out"):
        mr.compare(golden, other, leave=["enable"])


def test_a_longer_file_is_told(tmp_path):
    written(tmp_path / "a.vcd", 300)
    written(tmp_path / "b.vcd", 310)
    report = mr.compare(tmp_path / "a.vcd", tmp_path / "b.vcd")
    assert report.equal and not report.same_length


def test_wrong_files_are_refused(tmp_path):
    written(tmp_path / "a.vcd", 30)
    text = tmp_path / "text.vcd"
    text.write_text("no waves")
    with pytest.raises(ValueError, match="text.vcd"):
        mr.compare(tmp_path / "a.vcd", text)
    with pytest.raises(FileNotFoundError):
        mr.compare(tmp_path / "a.vcd", tmp_path / "b.vcd")
    with pytest.raises(ValueError, match="clock"):
        mr.compare(tmp_path / "a.vcd", tmp_path / "a.vcd", clock="nothing")


def test_wrong_calls_are_refused(tmp_path):
    model = mr.Model("enable_counter", width=8)
    with pytest.raises(ValueError, match="allowed: .vcd, .fst"):
        model.waves(tmp_path / "a.txt")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        model.waves(tmp_path / "file" / "a.vcd")
    then = model.snapshot()
    model.waves(tmp_path / "a.vcd")
    with pytest.raises(RuntimeError, match="no other waves can be begun"):
        model.waves(tmp_path / "b.vcd")
    with pytest.raises(RuntimeError, match="a snapshot cannot be restored"):
        model.restore(then)


def test_waves_that_are_not_finished_leave_no_file(tmp_path):
    model = mr.Model("enable_counter", width=8)
    model.waves(tmp_path / "deep" / "a.vcd")
    model.step(10)
    del model
    assert list(tmp_path.iterdir()) == []
