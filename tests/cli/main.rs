//! The command line: what it prints, writes, refuses and exits with; what the notes and the README
//! say.

mod arc;
mod arc_arm;
mod arc_files;
mod arc_mechanism;
mod arc_products;
mod arc_refusals;
mod beside;
mod check_parts;
mod checks;
mod colors;
#[cfg(unix)]
mod commands;
mod compare;
mod compare_names;
mod compare_odd;
mod compare_ports;
mod compare_refusals;
mod damage;
mod drawings;
mod dumps;
mod fault_reports;
mod files;
mod fst;
mod json_schema;
mod key_ends;
mod keys;
mod lead_angle;
mod lenient;
mod linear;
mod linear_master;
mod linear_refusals;
mod log_columns;
mod machine;
mod machine_waves;
#[cfg(target_os = "linux")]
mod memory;
mod mutate;
mod notes;
mod patterns;
mod plan;
mod program;
mod progress;
mod readme;
mod refusals;
mod runs;
mod scenarios;
mod series;
mod series_ticks;
mod settings;
#[cfg(unix)]
mod signals;
mod step_motors;
mod streams;
mod subroutines;
mod summaries;
mod support;
mod tables;
mod trajectory;
mod trajectory_refusals;
mod verilog;
#[cfg(unix)]
mod viewer;
mod waves_of;
mod written;
