// address_sequencer: read address: counts at RST, repeats, stops, switches patterns.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module address_sequencer (
    input  wire       clk,
    input  wire       rst,            // Registers to their power-on values; memories stay.
    input  wire       unit_rst,       // RST: high in the last tick of the unit time.
    input  wire       pending,        // A command is waiting.
    input  wire [3:0] pending_base,   // First address of the waiting command's pattern.
    input  wire [3:0] pending_last,   // Last address of the waiting command's pattern.
    input  wire       pending_cyclic, // The waiting command's pattern repeats after its last word.
    input  wire       pending_run,    // High: the waiting command starts a pattern; low: it stops the
                                      // running one.
    input  wire       pending_now,    // High: the waiting command is taken at the next RST; low: at
                                      // the RST that ends the running pattern.
    output wire       state,          // State: RUN while a pattern runs. 0 IDLE, 1 RUN.
    output wire [3:0] address,        // Address of the current unit time.
    output wire       take,           // The waiting command is taken at the end of this tick.
    output wire [3:0] next_address,   // Address of the next unit time; valid in the tick of RST.
    output wire       read,           // The pattern memories read next_address.
    output wire       blank           // The next unit time has no pulses.
);

    reg        state_reg = 1'b0;
    reg  [3:0] address_reg = 4'd0;
    reg  [3:0] base = 4'd0;        // First address of the running pattern.
    reg  [3:0] last = 4'd0;        // Last address of the running pattern.
    reg        cyclic = 1'b0;      // The running pattern repeats after its last word.
    assign state = state_reg;
    assign address = address_reg;

    // The address is the last of the pattern.
    wire at_last = address == last;
    // The address is the last of the pattern, or no pattern runs.
    wire at_end = !state || at_last;
    // The waiting command can be taken at an RST in this tick.
    wire due = pending && (at_end || pending_now);
    // The waiting command can be taken, and starts a pattern.
    wire start = due && pending_run;
    // Next address of the running pattern.
    wire [3:0] following = at_last && cyclic ? base : address + 4'd1;
    // A pattern runs in the next unit time; valid in the tick of RST.
    wire go_on = due ? pending_run : state && (!at_last || cyclic);
    assign next_address = go_on ? (start ? pending_base : following) : address;
    assign take = unit_rst && due;
    assign read = unit_rst && go_on;
    assign blank = unit_rst && !go_on;

    always @(posedge clk)
        if (rst) begin
            state_reg <= 1'b0;
            address_reg <= 4'd0;
            base <= 4'd0;
            last <= 4'd0;
            cyclic <= 1'b0;
        end else begin
            if (unit_rst) begin
                state_reg <= go_on;
                address_reg <= next_address;
            end
            if (unit_rst && start) begin
                base <= pending_base;
                last <= pending_last;
                cyclic <= pending_cyclic;
            end
        end

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // state and address change only at RST.
        if (f_past_valid && !$past(rst))
            assert ($past(unit_rst) || (state == $past(state) && address == $past(address)));
        // A command is taken at RST if pending_now is high, in IDLE, or at the last address.
        assert (!(take ^ (unit_rst && pending && (pending_now || !state || at_last))));
        // A command with pending_run starts its pattern at pending_base.
        if (f_past_valid && !$past(rst))
            assert (!($past(unit_rst) && $past(take) && $past(pending_run)) ||
                (state &&
                 address == $past(pending_base) &&
                 base == $past(pending_base) &&
                 last == $past(pending_last) &&
                 !(cyclic ^ $past(pending_cyclic))));
        // A command without pending_run stops the pattern and holds the address.
        if (f_past_valid && !$past(rst))
            assert (!($past(unit_rst) && $past(take) && !$past(pending_run)) ||
                (!state && address == $past(address)));
        // Without a command, a running pattern advances by one address per RST.
        if (f_past_valid && !$past(rst))
            assert (!($past(unit_rst) && !$past(take) && $past(state) &&
                 $past(address) != $past(last)) ||
                (state && address == $past(address) + 4'd1));
        // After the last address, a cyclic pattern restarts and any other stops there.
        if (f_past_valid && !$past(rst))
            assert (!($past(unit_rst) && !$past(take) && $past(state) &&
                 $past(address) == $past(last)) ||
                ($past(cyclic) ? state && address == $past(base) :
                 !state && address == $past(address)));
        // In IDLE, state and address stay until a command is taken.
        if (f_past_valid && !$past(rst))
            assert (!($past(unit_rst) && !$past(take) && !$past(state)) ||
                (!state && address == $past(address)));
        // RST reads the next address if a pattern runs next, and otherwise blanks.
        if (f_past_valid && !$past(rst))
            assert (!(($past(read) || $past(blank)) ^ $past(unit_rst)) &&
                !($past(read) && $past(blank)) &&
                (!$past(read) || (state && address == $past(next_address))) &&
                (!$past(blank) || !state));
    end
`endif

endmodule
