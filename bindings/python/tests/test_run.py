"""Runs with arrays."""

import numpy as np
import pytest

import motion_rtl as mr


@pytest.fixture
def counter():
    return mr.Model("enable_counter", width=8)


def test_a_run_is_the_steps(counter):
    random = np.random.default_rng(1)
    periods = random.integers(1, 8, 40_000)
    out = counter.run({"period": periods}, watch=["enable", "count"])

    other = mr.Model("enable_counter", width=8)
    enables, counts = [], []
    for period in periods:
        other["period"] = period
        enables.append(other["enable"])
        counts.append(other["count"])
        other.step()
    assert np.array_equal(out["enable"], enables)
    assert np.array_equal(out["count"], counts)
    assert 1_000 < out["enable"].sum() < 39_000
    assert counter.tick == other.tick == 40_000
    assert counter["count"] == other["count"]


def test_types_of_arrays(counter):
    out = counter.run({"period": [3] * 5}, ["enable", "count"])
    assert list(out) == ["enable", "count"]
    assert out["enable"].dtype == bool and out["count"].dtype == np.uint64
    assert out["enable"].shape == out["count"].shape == (5,)
    model = mr.Model("linear_interpolator", {"widths.position": 20})
    out = model.run({"target_x": [-5, 7]}, ["target_x"])
    assert out["target_x"].dtype == np.int64 and out["target_x"].tolist() == [-5, 7]


@pytest.mark.parametrize("dtype", ["i1", "u1", "<i2", ">i4", "u4", "i8", "u8", ">u8"])
def test_integers_of_any_size_are_taken(dtype, counter):
    values = np.array([2, 2, 2, 2], dtype)
    assert counter.run({"period": values}, "enable")["enable"].tolist() == [False, True] * 2


def test_bits_and_strides_are_taken(counter):
    values = np.arange(20)[::2]
    out = counter.run({"period": values}, "period")
    assert out["period"].tolist() == values.tolist()
    bits = np.array([True, False, True])
    assert counter.run({"period": bits}, "period")["period"].tolist() == [1, 0, 1]


def test_output_ports_are_watched_unless_others_are_named(counter):
    out = counter.run(ticks=3)
    ports = [path for path, signal in counter.signals.items() if signal.port == "out"]
    assert list(out) == ports and ports
    assert counter.run(ticks=3, watch=[]) == {}
    assert counter.tick == 6


def test_a_signal_stands_for_its_name(counter):
    period, count = (counter.signals[name] for name in ("period", "count"))
    out = counter.run({period: [9] * 4}, [count])
    assert out["count"].tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("value", [5, np.int32(5), np.array(5)])
def test_a_number_holds_for_all_ticks(value, counter):
    out = counter.run({"period": value}, "count", ticks=11)
    assert out["count"].tolist() == [tick % 5 for tick in range(11)]
    assert counter["period"] == 5


def test_no_ticks(counter):
    out = counter.run({"period": []}, "count")
    assert out["count"].shape == (0,) and counter.tick == 0


def test_lengths_have_to_agree():
    model = mr.Model("linear_interpolator")
    with pytest.raises(ValueError, match="target_y: has 2 values, but target_x has 3"):
        model.run({"target_x": [1, 2, 3], "target_y": [1, 2]})
    with pytest.raises(ValueError, match="target_x: has 3 values, but ticks is 4"):
        model.run({"target_x": [1, 2, 3]}, ticks=4)
    with pytest.raises(ValueError, match="ticks: not given"):
        model.run({"target_x": 1})
    with pytest.raises(ValueError, match="ticks: is -1"):
        model.run(ticks=-1)
    assert model.tick == 0 and model["target_x"] == 0


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ([1, 2, 256], "tick 12: port in period: 256 does not fit; allowed are 0 to 255"),
        ([1, -1, 2], "tick 11: port in period: -1 does not fit; allowed are 0 to 255"),
        (np.array([2**64 - 1], "u8"), "tick 10: port in period: 18446744073709551615 does not"),
    ],
)
def test_no_tick_happens_if_a_value_does_not_fit(values, text, counter):
    counter["period"] = 77
    counter.step(10)
    with pytest.raises(ValueError, match=text):
        counter.run({"period": values})
    assert (counter.tick, counter["period"]) == (10, 77)


def test_a_late_value_that_does_not_fit_stops_the_first_tick(counter):
    values = np.ones(100_000, int)
    values[-1] = 256
    with pytest.raises(ValueError, match="tick 99999: port in period: 256"):
        counter.run({"period": values})
    assert counter.tick == 0


def test_a_full_word_is_no_negative_number():
    model = mr.Model("enable_counter", width=64)
    with pytest.raises(ValueError, match="-1 does not fit"):
        model.run({"period": [-1]})
    assert model.run({"period": np.array([2**64 - 1], "u8")}, "period")["period"] == 2**64 - 1


def test_nothing_is_set_if_another_port_is_refused():
    model = mr.Model("linear_interpolator")
    for inputs in ({"target_x": 1, "target_y": 2**40}, {"target_x": 1, "nothing": 1}):
        with pytest.raises((ValueError, KeyError)):
            model.run(inputs, ticks=3)
        assert (model.tick, model["target_x"]) == (0, 0)


def test_arrays_of_another_kind_are_refused(counter):
    with pytest.raises(TypeError, match="period: has dtype float64; allowed: bool and integers"):
        counter.run({"period": [1.0, 2.0]})
    with pytest.raises(TypeError, match="period: has dtype object"):
        counter.run({"period": [2**100]})
    with pytest.raises(ValueError, match="period: has 2 dimensions"):
        counter.run({"period": [[1, 2]]})
    with pytest.raises(TypeError, match="period: has dtype float64"):
        counter.run({"period": 1.5}, ticks=1)
    # The values under a mask are none.
    with pytest.raises(TypeError, match="period: is a masked array; allowed: an array without"):
        counter.run({"period": np.ma.array([1, 2], mask=[False, True])})


def test_unknown_signals_are_refused(counter):
    with pytest.raises(KeyError, match="near it: period"):
        counter.run({"perod": [1]})
    with pytest.raises(KeyError, match="near it: enable"):
        counter.run({"period": [1]}, ["enabel"])
    with pytest.raises(ValueError, match="only input ports can be set"):
        counter.run({"count": [1]})
    with pytest.raises(ValueError, match="given twice"):
        counter.run({"period": [1], counter.signals["period"]: [2]})
    assert counter.tick == 0


def test_more_ticks_than_memory(counter):
    with pytest.raises(MemoryError):
        counter.run(ticks=2**62)
    assert counter.tick == 0
