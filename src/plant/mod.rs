//! What is no hardware of ours: motors, encoders, loads. Behavioural, plain programs on the same
//! reference tick.
