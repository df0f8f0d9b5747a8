//! Results of functions.

/// No error.
pub const MRTL_OK: i32 = 0;
/// No model, or no snapshot, has this handle.
pub const MRTL_WRONG_HANDLE: i32 = -1;
/// A pointer is NULL.
pub const MRTL_NULL: i32 = -2;
/// A string is not UTF-8.
pub const MRTL_NOT_UTF8: i32 = -3;
/// The catalogue has no circuit, or the circuit has no signal, of this name.
pub const MRTL_UNKNOWN: i32 = -4;
/// The circuit does not take the settings.
pub const MRTL_SETTINGS: i32 = -5;
/// The circuit cannot be run.
pub const MRTL_CIRCUIT: i32 = -6;
/// No signal has this index.
pub const MRTL_WRONG_INDEX: i32 = -7;
/// The signal is not an input port and cannot be set.
pub const MRTL_NO_INPUT: i32 = -8;
/// The value does not fit the port.
pub const MRTL_VALUE: i32 = -9;
/// The snapshot is of another circuit.
pub const MRTL_OTHER_CIRCUIT: i32 = -10;
/// Waves cannot be begun or written, or do not allow the call.
pub const MRTL_WAVES: i32 = -11;
/// The bench was made for another version of the ABI or for other ports.
pub const MRTL_MISMATCH: i32 = -12;
/// Another thread is inside a call with this handle.
pub const MRTL_BUSY: i32 = -13;
/// A fault inside the library, in this call or an earlier one. The model can only be freed.
pub const MRTL_PANIC: i32 = -14;
/// Too many models, or too many snapshots, at once: 65,536.
pub const MRTL_FULL: i32 = -15;
/// An error of another kind.
pub const MRTL_OTHER: i32 = -16;

/// Direction of a signal that is not a port.
pub const MRTL_INNER: i32 = 0;
/// Direction of an input port.
pub const MRTL_IN: i32 = 1;
/// Direction of an output port.
pub const MRTL_OUT: i32 = 2;

/// Role of an input port of the circuit or of a part.
pub const MRTL_INPUT: i32 = 0;
/// Role of a flip-flop or a word of a memory.
pub const MRTL_REGISTER: i32 = 1;
/// Role of a combinational net.
pub const MRTL_NET: i32 = 2;
