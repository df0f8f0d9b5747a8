"""Models: signals set and read, ticks, states, errors."""

import copy
import re

import numpy as np
import pytest

import motion_rtl as mr


@pytest.fixture
def counter():
    return mr.Model("enable_counter", width=8)


def test_a_counter_counts(counter):
    counter["period"] = 4
    enables = []
    for _ in range(12):
        enables.append(counter["enable"])
        counter.step()
    assert enables == [tick % 4 == 3 for tick in range(12)]
    assert counter.tick == 12


def test_a_bit_is_a_bool_and_a_word_an_int(counter):
    assert counter["enable"] is True
    counter["period"] = 2
    assert counter["enable"] is False
    assert type(counter["count"]) is int


def test_a_signed_port_takes_and_gives_negative_numbers():
    model = mr.Model("linear_interpolator", {"widths.position": 20})
    signal = model.signals["target_x"]
    assert (signal.kind, signal.width, signal.signed) == ("signed", 20, True)
    assert (signal.least, signal.greatest) == (-(2**19), 2**19 - 1)
    for value in (-1, signal.least, signal.greatest):
        model["target_x"] = value
        assert model["target_x"] == value
    for value in (signal.least - 1, signal.greatest + 1):
        with pytest.raises(ValueError, match=f"{value} does not fit"):
            model["target_x"] = value


def test_settings_are_keywords_dotted_keys_or_dicts():
    dotted = mr.Model("linear_interpolator", {"widths.position": 20}, rule="truncating")
    inside = mr.Model("linear_interpolator", {"widths": {"position": 20}, "rule": "truncating"})
    assert repr(dotted) == repr(inside)
    assert "widths.position=20" in repr(dotted)
    assert dotted.signals["target_x"].width == inside.signals["target_x"].width == 20


@pytest.mark.parametrize("value", [True, np.True_, np.uint8(1), np.int64(1), 1])
def test_values_of_python_and_numpy_are_taken(value, counter):
    counter["period"] = value
    assert counter["period"] == 1


@pytest.mark.parametrize("value", [1.0, "1", None, [1], np.float64(1)])
def test_what_is_no_whole_number_is_refused(value, counter):
    with pytest.raises(TypeError, match="a value is a whole number or a bool, not "):
        counter["period"] = value
    assert counter["period"] == 0


@pytest.mark.parametrize("value", [-1, 256, 2**63, 2**64, -(2**63) - 1, 2**200])
def test_a_value_that_does_not_fit_is_refused(value, counter):
    with pytest.raises(ValueError, match=f"{value} does not fit"):
        counter["period"] = value
    assert counter["period"] == 0


def test_an_unknown_name_tells_the_nearest(counter):
    with pytest.raises(KeyError, match="no signal enabel; near it: enable"):
        counter["enabel"]
    with pytest.raises(KeyError, match="near it: period"):
        counter["perod"] = 1
    with pytest.raises(KeyError, match="did you mean enable_counter"):
        mr.Model("enable_countr")


def test_only_input_ports_can_be_set(counter):
    with pytest.raises(ValueError, match="only input ports can be set"):
        counter["count"] = 1


def test_an_unknown_setting_tells_the_allowed_ones():
    with pytest.raises(ValueError, match="did you mean width.*allowed: width"):
        mr.Model("enable_counter", widht=8)
    with pytest.raises(ValueError, match="width: given twice"):
        mr.Model("enable_counter", {"width": 8}, width=9)
    with pytest.raises(TypeError, match="width: is object"):
        mr.Model("enable_counter", width=object())
    with pytest.raises(TypeError, match="settings are a dict"):
        mr.Model("enable_counter", 8)


def test_a_signal_of_another_kind_is_refused(counter):
    with pytest.raises(TypeError, match="a signal is a str or a Signal, not int"):
        counter[3]
    with pytest.raises(TypeError):
        3 in counter  # noqa: B015


def test_signals_are_described(counter):
    assert list(counter.signals) == counter.keys() == list(counter)
    assert len(counter) == len(counter.signals)
    assert "period" in counter and "nothing" not in counter
    assert counter._ipython_key_completions_() == counter.keys()
    period = counter.signals["period"]
    assert (period.path, period.verilog, period.port, period.role) == (
        "period",
        "period",
        "in",
        "input",
    )
    assert (period.kind, period.width, period.least, period.greatest) == ("unsigned", 8, 0, 255)
    assert period.doc and period.doc in repr(period)
    assert counter.signals["enable"].port == "out"
    with pytest.raises(TypeError):
        counter.signals["period"] = None


def test_states_have_names():
    model = mr.Model("trajectory_controller")
    states = [signal for signal in model.signals.values() if signal.format == "states"]
    assert states
    assert all(len(signal.states) > 1 for signal in states)


def test_a_signal_stands_for_its_name(counter):
    period = counter.signals["period"]
    counter[period] = 7
    assert counter["period"] == counter[period] == 7
    other = mr.Model("enable_counter", width=9)
    with pytest.raises(
        ValueError, match="the handle is of another circuit .*, or of other settings"
    ):
        other[period]


def test_a_word_of_a_memory_is_read():
    model = mr.Model("pulse_interpolator")
    word = next(path for path in model.signals if path.endswith("[0]"))
    assert model[word] == model.signals[word].power_on


def test_reset_is_a_tick(counter):
    counter["period"] = 100
    counter.step(30)
    assert counter["count"] == 30
    counter.reset()
    assert (counter["count"], counter.tick, counter["period"]) == (0, 31, 100)


@pytest.mark.parametrize("ticks", [0, 1, 2, 64, 65, 16_384, 16_385, 50_000])
def test_steps_are_counted(ticks, counter):
    counter["period"] = 251
    counter.step(ticks)
    assert (counter.tick, counter["count"]) == (ticks, ticks % 251)


@pytest.mark.parametrize(
    ("ticks", "error", "text"),
    [
        (-1, ValueError, "is -1; allowed: 0 to 18446744073709551615"),
        (2**64, ValueError, "allowed: 0 to 18446744073709551615"),
        (1.5, TypeError, "not float"),
        (np.array([5]), TypeError, "scalar"),
    ],
)
def test_a_wrong_number_of_ticks_is_refused(ticks, error, text, counter):
    with pytest.raises(error, match=text):
        counter.step(ticks)
    assert counter.tick == 0


def test_a_snapshot_goes_back(counter):
    counter["period"] = 100
    counter.step(60)
    then = counter.snapshot()
    counter["period"] = 3
    counter.step(10)
    counter.restore(then)
    assert (counter.tick, counter["count"], counter["period"], then.tick) == (60, 60, 100, 60)
    with pytest.raises(
        ValueError, match="the snapshot is of another circuit .*, or of other settings"
    ):
        mr.Model("enable_counter", width=9).restore(then)


@pytest.mark.parametrize("copied", [mr.Model.copy, copy.copy, copy.deepcopy])
def test_a_copy_goes_its_own_way(copied, counter):
    counter["period"] = 100
    counter.step(5)
    other = copied(counter)
    other.step(5)
    assert (counter["count"], other["count"]) == (5, 10)
    assert (counter.tick, other.tick) == (5, 10)


def test_representations(counter):
    counter.step(3)
    assert repr(counter) == "<Model enable_counter width=8, tick 3>"
    assert repr(counter.snapshot()) == "<Snapshot of enable_counter, tick 3>"
    text = repr(counter.signals["enable"])
    assert re.match(r"<Signal enable, port out, bit: ", text), text
