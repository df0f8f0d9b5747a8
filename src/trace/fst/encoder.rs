use super::header::{Counts, Variable, declarations, header};
use super::sorted::{Sorted, Value};
use super::varint::{signed, unsigned};
use crate::trace::Clock;
use crate::trace::behind::Sink;
use crate::trace::layout::Layout;
use crate::trace::section::Section;
use crate::trace::vcd::eight_digits;
use lz4_flex::block::{CompressTable, compress_into_with_table, get_maximum_output_size};
use miniz_oxide::deflate::compress_to_vec_zlib;
use std::io::{self, Seek, SeekFrom, Write};

/// Block kind of a section of values.
const VALUES: u8 = 8;
/// Packing of value chains: LZ4.
const LZ4: u8 = b'4';
/// Length in bytes below which packing gains nothing.
const WORTH_PACKING: usize = 32;
/// Level of zlib for frames and times, which have many repetitions.
const ZLIB: u8 = 1;

/// Writer of sections.
pub(crate) struct Encoder<W> {
    out: W,
    clock: Clock,
    counts: Counts,
    variables: Vec<Variable>,
    frame: Frame,
    sorted: Sorted,
    chain: Vec<u8>,
    bytes: Vec<u8>,
    table: CompressTable,
}

/// Values of all variables as text: one digit per bit.
struct Frame {
    digits: Vec<u8>,
    /// Position of `clk`.
    clk: usize,
    /// Position and width of each leaf; width 0 if it is not selected.
    places: Vec<(usize, usize)>,
}

impl Frame {
    /// Creates a frame in which all bits are 0.
    fn new(variables: &[Variable], leaves: usize) -> Self {
        let (mut len, mut clk) = (0, 0);
        let mut places = vec![(0, 0); leaves];
        for variable in variables {
            match *variable {
                Variable::Clk => clk = len,
                Variable::Bits { leaf, width } => places[leaf] = (len, width),
                Variable::Names { .. } => {}
            }
            len += variable.width();
        }
        Frame {
            digits: vec![b'0'; len],
            clk,
            places,
        }
    }

    fn set(&mut self, leaf: usize, bits: u64) {
        let (at, width) = self.places[leaf];
        let digits = left(bits, width).to_be_bytes().map(eight_digits);
        self.digits[at..at + width].copy_from_slice(&digits.as_flattened()[..width]);
    }
}

impl<W> std::fmt::Debug for Encoder<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Encoder").finish_non_exhaustive()
    }
}

impl<W: Write + Seek> Encoder<W> {
    /// Writes the header of the file.
    pub fn new(mut out: W, layout: &Layout, clock: Clock) -> io::Result<Self> {
        let mut bytes = header(clock, Counts::default());
        let (variables, scopes) = declarations(&mut bytes, layout);
        out.write_all(&bytes)?;
        Ok(Encoder {
            out,
            clock,
            counts: Counts {
                scopes,
                variables: variables.len() as u64,
                ..Counts::default()
            },
            frame: Frame::new(&variables, layout.leaves.len()),
            variables,
            sorted: Sorted::default(),
            chain: Vec::new(),
            bytes,
            table: CompressTable::large(),
        })
    }

    /// Reserves space for a number that is known later.
    fn place(&mut self) -> usize {
        self.bytes.extend([0; 8]);
        self.bytes.len() - 8
    }

    fn fill(&mut self, place: usize, number: u64) {
        self.bytes[place..place + 8].copy_from_slice(&number.to_be_bytes());
    }

    /// Writes the initial values of the section: the last ones of the section before or, in the
    /// first section, those of its first tick.
    fn frame(&mut self) {
        let frame = &mut self.frame;
        let first = self.counts.sections == 0;
        frame.digits[frame.clk] = if first { b'1' } else { b'0' };
        if first {
            for leaf in 0..frame.places.len() {
                if let Some(value) = self.sorted.run(leaf).first() {
                    frame.set(leaf, value.bits);
                }
            }
        }
        unsigned(&mut self.bytes, frame.digits.len() as u64);
        let packed = pack(&frame.digits);
        unsigned(&mut self.bytes, packed.len() as u64);
        unsigned(&mut self.bytes, self.variables.len() as u64);
        self.bytes.extend_from_slice(&packed);
    }

    /// Writes the value chains of all variables and their positions. Returns their unpacked size
    /// in bytes.
    fn chains(&mut self, ticks: usize) -> u64 {
        unsigned(&mut self.bytes, self.variables.len() as u64);
        let mut last = self.bytes.len();
        self.bytes.push(LZ4);
        let (mut places, mut without, mut unpacked) = (Vec::new(), 0, 0);
        for variable in &self.variables {
            self.chain.clear();
            match *variable {
                Variable::Clk => clk(&mut self.chain, ticks),
                Variable::Bits { leaf, width } => {
                    bits(&mut self.chain, self.sorted.run(leaf), width);
                }
                Variable::Names { leaf, names } => {
                    strings(&mut self.chain, self.sorted.run(leaf), names);
                }
            }
            if self.chain.is_empty() {
                without += 1;
                continue;
            }
            if without > 0 {
                unsigned(&mut places, without << 1);
                without = 0;
            }
            let start = self.bytes.len();
            signed(&mut places, ((start - last) as i64) << 1 | 1);
            last = start;
            unpacked += self.chain.len() as u64;
            put(&mut self.bytes, &self.chain, &mut self.table);
        }
        if without > 0 {
            unsigned(&mut places, without << 1);
        }
        self.bytes.extend_from_slice(&places);
        self.bytes.extend((places.len() as u64).to_be_bytes());
        unpacked
    }

    /// Writes the time table as differences.
    fn times(&mut self, section: &Section) {
        let edges = section.ticks.iter().flat_map(|tick| [tick.rise, tick.fall]);
        let (mut count, mut before) = (0, 0);
        self.chain.clear();
        for time in edges.chain(section.end) {
            unsigned(&mut self.chain, time - before);
            before = time;
            count += 1;
        }
        let packed = pack(&self.chain);
        self.bytes.extend_from_slice(&packed);
        for number in [self.chain.len() as u64, packed.len() as u64, count] {
            self.bytes.extend(number.to_be_bytes());
        }
    }
}

impl<W: Write + Seek + Send + 'static> Sink for Encoder<W> {
    type Out = W;

    fn full(&self) -> (usize, usize) {
        // The more is packed together, the smaller is the file. A section also begins with the
        // values of all signals, so it has several changes per signal.
        let changes = (128 * 1024).max(8 * self.frame.places.len());
        (changes, changes / 4)
    }

    fn write(&mut self, section: &Section) -> io::Result<()> {
        let last_tick = section.ticks.last().map(|tick| tick.fall);
        let Some(end) = section.end.or(last_tick) else {
            // No tick.
            return Ok(());
        };
        if self.counts.sections == 0 {
            let first = section.ticks.first().map_or(end, |first| first.rise);
            (self.counts.start, self.counts.end) = (first, first);
        }
        let start = self.counts.end;
        self.sorted.sort(section, self.frame.places.len());

        self.bytes.clear();
        self.bytes.push(VALUES);
        let length = self.place();
        self.bytes.extend(start.to_be_bytes());
        self.bytes.extend(end.to_be_bytes());
        let unpacked = self.place();
        self.frame();
        let chains = self.chains(section.ticks.len());
        self.times(section);
        self.fill(length, (self.bytes.len() - length) as u64);
        self.fill(unpacked, chains);
        self.out.write_all(&self.bytes)?;

        for leaf in 0..self.frame.places.len() {
            if let Some(last) = self.sorted.run(leaf).last() {
                self.frame.set(leaf, last.bits);
            }
        }
        self.counts.end = end;
        self.counts.sections += 1;
        Ok(())
    }

    /// Completes the header.
    fn finish(mut self) -> io::Result<W> {
        self.out.seek(SeekFrom::Start(0))?;
        self.out.write_all(&header(self.clock, self.counts))?;
        self.out.flush()?;
        Ok(self.out)
    }
}

/// Packs by zlib if that is shorter: readers tell by the length.
fn pack(bytes: &[u8]) -> Vec<u8> {
    let packed = compress_to_vec_zlib(bytes, ZLIB);
    match packed.len() < bytes.len() {
        true => packed,
        false => bytes.to_vec(),
    }
}

/// Writes a chain with its length, which is 0 if it is not packed.
fn put(out: &mut Vec<u8>, chain: &[u8], table: &mut CompressTable) {
    let start = out.len();
    if chain.len() >= WORTH_PACKING {
        unsigned(out, chain.len() as u64);
        let begin = out.len();
        out.resize(begin + get_maximum_output_size(chain.len()), 0);
        let packed = compress_into_with_table(chain, &mut out[begin..], table);
        if let Ok(packed) = packed
            && packed < chain.len()
        {
            out.truncate(begin + packed);
            return;
        }
        out.truncate(start);
    }
    out.push(0);
    out.extend_from_slice(chain);
}

/// Aligns the bits of a word to the highest.
fn left(bits: u64, width: usize) -> u64 {
    bits << (64 - width.clamp(1, 64))
}

/// Adds the chain of `clk`: high at the first of the two times of each tick, low at the second.
fn clk(chain: &mut Vec<u8>, ticks: usize) {
    let high = 1 << 2 | 1 << 1;
    let low = 1 << 2;
    chain.extend([high, low].repeat(ticks));
    if let Some(first) = chain.first_mut() {
        // The first edge is at the first time, not one after it.
        *first = 1 << 1;
    }
}

fn bits(chain: &mut Vec<u8>, run: &[Value], width: usize) {
    let mut last = 0;
    for &Value { place, bits } in run {
        let later = u64::from(place - last);
        last = place;
        if width == 1 {
            unsigned(chain, later << 2 | bits << 1);
        } else {
            unsigned(chain, later << 1);
            let bytes = left(bits, width).to_be_bytes();
            chain.extend_from_slice(&bytes[..width.div_ceil(8)]);
        }
    }
}

fn strings(chain: &mut Vec<u8>, run: &[Value], names: &[&str]) {
    let mut last = 0;
    for &Value { place, bits } in run {
        unsigned(chain, u64::from(place - last) << 1);
        last = place;
        let name = usize::try_from(bits).ok().and_then(|bits| names.get(bits));
        let number = bits.to_string();
        let text = name.map_or(&*number, |name| name);
        unsigned(chain, text.len() as u64);
        chain.extend_from_slice(text.as_bytes());
    }
}
