//! States a second and bytes a state of proofs by exhaustion.

use divan::counter::ItemsCount;
use motion_rtl::check::{Proof, Specified, reach};
use motion_rtl::circuits::blocks::{MulDiv, QuadratureCounter};
use motion_rtl::circuits::pulse_interpolator::{UnitLaw, Variant};

fn proof<C: Specified>(circuit: &C) -> Proof {
    let invariants = circuit.invariants();
    let outcome = reach(circuit, &invariants)
        .inputs(|i| circuit.applies(i))
        .run()
        .expect("narrow enough");
    outcome.proof().expect("it holds")
}

/// In states a second; transitions are shown once.
fn measure<C: Specified>(bencher: divan::Bencher<'_, '_>, circuit: &C) {
    let Proof {
        states,
        transitions,
        ..
    } = proof(circuit);
    println!("{}: {states} states, {transitions} transitions", C::NAME);
    bencher
        .counter(ItemsCount::new(states))
        .bench_local(|| proof(circuit));
}

#[divan::bench(sample_count = 5)]
fn unit_law_of_4_bits(bencher: divan::Bencher<'_, '_>) {
    let (width, variant) = (4, Variant::Safe);
    measure(bencher, &UnitLaw { width, variant });
}

#[divan::bench(sample_count = 5)]
fn mul_div_of_3_bits(bencher: divan::Bencher<'_, '_>) {
    measure(bencher, &MulDiv::new(2, 3));
}

#[divan::bench(sample_count = 5)]
fn quadrature_counter_of_4_bits(bencher: divan::Bencher<'_, '_>) {
    measure(bencher, &QuadratureCounter { width: 4 });
}

fn main() {
    divan::main();
}
