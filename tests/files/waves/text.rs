use super::zoo::{Part, PartIn};
use super::{SEED, options, run_zoo};
use expect_test::expect;
use motion_rtl::hdl::Cut;
use motion_rtl::sim::{Simulator, State};
use motion_rtl::trace::{Options, RecordError, Recorder, text};

fn part(ticks: u64) -> Recorder {
    let mut recorder = Recorder::new(&Part, &Options::default()).unwrap();
    let stimulus = |tick: u64, _: &State<'_, Part>| PartIn {
        step: (tick / 3 + 1).cut(3),
        up: tick % 4 == 3,
    };
    Simulator::new(&Part)
        .unwrap()
        .run(ticks, stimulus, &mut recorder)
        .unwrap();
    recorder
}

#[test]
fn waves_as_text() {
    expect![[r#"
        tick        0    1    2    3    4    5    6    7    8    9    10   11   12
        step        1              2              3              4              5
        up          _______________#####_______________#####_______________#####_____
        level       0    -1   -2   -3   -1   -3   -5   -8   -5   -8   -12  -16  -12
        phase       IDLE RUN
        next_level  -1   -2   -3   -1   -3   -5   -8   -5   -8   -12  -16  -12  -17
        wrapped     #####____________________________________________________________
    "#]]
    .assert_eq(&text::waves(&part(13), 0..13));
}

#[test]
fn a_piece_of_narrow_waves_labels_the_ticks_that_have_room() {
    expect![[r#"
        tick        98   99   100  101  102  103  104  105  106  107  108  109  110  111  112  113  114
        step        1    2              3              4              5              6              7
        up          _____#####_______________#####_______________#####_______________#####_______________
        level       -162 -163 -161 -163 -165 -168 -165 -168 -172 -176 -172 -177 -182 -187 -181 -187 -193
        phase       RUN
        next_level  -163 -161 -163 -165 -168 -165 -168 -172 -176 -172 -177 -182 -187 -181 -187 -193 -200
        wrapped     _____________________________________________________________________________________
    "#]].assert_eq(&text::waves(&part(115), 98..u64::MAX));
}

#[test]
fn words_of_memories_that_hold_still_are_left_out() {
    let (_, recorder) = run_zoo(40, &Options::default());
    let text = text::waves(&recorder, 0..40);
    let rows: Vec<_> = text
        .lines()
        .filter(|line| line.starts_with("store."))
        .collect();
    assert!(!rows.is_empty() && rows.len() < 16, "{SEED}: {text}");
    assert_eq!(
        text.lines()
            .filter(|line| line.starts_with("flags"))
            .count(),
        3
    );
}

#[test]
fn a_recorder_keeps_its_window_and_its_signals() {
    let mut recorder = Recorder::new(&Part, &options(5..9, &["part.level", "part.up"])).unwrap();
    let stimulus = |_: u64, _: &State<'_, Part>| PartIn { step: 1, up: true };
    Simulator::new(&Part)
        .unwrap()
        .run(20, stimulus, &mut recorder)
        .unwrap();
    assert_eq!(recorder.ticks(), 5..9);
    assert_eq!(recorder.leaves().len(), 2);
    assert_eq!(recorder.column("part.level").unwrap(), [5, 6, 7, 8]);
    assert_eq!(recorder.at(8, "part.up"), Ok(1));
    for tick in [4, 9] {
        assert_eq!(
            recorder.at(tick, "part.up"),
            Err(RecordError::Tick {
                tick,
                recorded: 5..9
            })
        );
    }
    assert_eq!(
        recorder.at(5, "part.levle").unwrap_err().to_string(),
        "no signal part.levle was recorded; near it: part.level, part.up"
    );
}
