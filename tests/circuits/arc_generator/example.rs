//! The path of the note, word by word.

use motion_rtl::circuits::arc_generator::ArcGenerator;
use motion_rtl::circuits::arc_generator::generator::{In, Segments};
use motion_rtl::circuits::blocks::RecordWrite;
use motion_rtl::hdl::Cut;
use motion_rtl::trace::LastTicks;

/// Words that are not 0: from rest to 64 counts, on to 128, to rest at 192.
const RECORDS: [&[(usize, i64)]; 3] = [
    &[
        (0, 4 << 3),
        (1, 256),
        (8, 114_688),
        (10, 557_056),
        (12, 196_608),
        (14, -393_216),
    ],
    &[(0, 1 + (2 << 3)), (1, 2), (2, 4_194_304), (8, 2_097_152)],
    &[
        (0, 4 + (4 << 3)),
        (1, 256),
        (2, 8_388_608),
        (8, 1_982_464),
        (10, -557_056),
        (12, -196_608),
        (14, 393_216),
    ],
];
const COMMANDS: [i64; 11] = [0, 2, 12, 34, 64, 96, 128, 158, 180, 190, 192];

#[test]
fn the_path_of_the_note() {
    let mut simulator = LastTicks::simulator(&ArcGenerator::default()).unwrap();
    let width = simulator.signals().i.segments.record.write_data.width();
    let mut seen = Vec::new();
    for tick in 0..1300 {
        let (record, word) = (tick / 32, tick % 32);
        let words = RECORDS.get(record);
        let data = words
            .and_then(|words| words.iter().find(|(number, _)| *number == word))
            .map_or(0, |(_, data)| *data);
        let i = In {
            segments: Segments {
                record: RecordWrite {
                    write: words.is_some(),
                    write_word: word as u64,
                    write_data: (data as u64).cut(width),
                    push: words.is_some() && word == 31,
                },
                start: tick == 96,
            },
            halt: false,
            sample_period: 100,
        };
        seen.extend(
            simulator
                .step_with(&i, |now| {
                    let w = now.w;
                    w.sampled.then(|| (tick, w.x, w.y))
                })
                .unwrap(),
        );
    }
    let ticks = (200..).step_by(100);
    let expected: Vec<_> = ticks.zip(COMMANDS).map(|(tick, x)| (tick, x, 0)).collect();
    assert_eq!(seen, expected);
    assert!(!simulator.see(|s| s.w.late) && !simulator.see(|s| s.w.starved));
}
