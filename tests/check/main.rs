//! Reachability, lockstep and monitors on circuits whose answers are known by hand, and what they
//! stand on: words and memories.

mod backends;
mod circuits;
mod composite;
mod floors;
mod language;
mod lockstep;
mod model;
mod monitor;
mod proofs;
mod prove;
mod reach;
mod report;
mod search;
mod statements;
mod sweep;
mod widths;
mod words;
