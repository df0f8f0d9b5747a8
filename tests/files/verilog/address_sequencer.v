// address_sequencer: read address: counts on RST, loops, stops, switches patterns.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module address_sequencer (
    input  wire       clk,
    input  wire       rst,            // Registers to their power-on values; memories stay.
    input  wire       unit_rst,       // Last tick of the unit time.
    input  wire       pending,        // A command waits.
    input  wire [3:0] pending_base,   // Its pattern's first address.
    input  wire [3:0] pending_last,   // Its pattern's last address.
    input  wire       pending_cyclic, // Its pattern starts again after its last word.
    input  wire       pending_run,    // High: starts a pattern; low: stops the running one.
    input  wire       pending_now,    // High: the command is taken at the next RST; low: at the RST
                                      // that ends the pattern.
    output wire       state,          // State: a pattern runs or not. 0 IDLE, 1 RUN.
    output wire [3:0] address,        // Address of the unit time that runs.
    output wire       take,           // The waiting command is taken with this tick.
    output wire [3:0] next_address,   // Address of the next unit time.
    output wire       read,           // The pattern memory reads next_address.
    output wire       blank           // The next unit time has no pulses.
);

    reg        state_reg = 1'b0;
    reg  [3:0] address_reg = 4'd0;
    reg  [3:0] base = 4'd0;        // First address of the pattern that runs.
    reg  [3:0] last = 4'd0;        // Last address of the pattern that runs.
    reg        cyclic = 1'b0;      // The pattern that runs starts again after its last word.
    assign state = state_reg;
    assign address = address_reg;

    // The unit time that runs is the last of its pattern.
    wire at_last = address == last;
    // The unit time is the last of its pattern, or no pattern runs.
    wire at_end = !state || at_last;
    // The waiting command is for the next RST.
    wire due = pending && (at_end || pending_now);
    // The waiting command starts a pattern.
    wire start = due && pending_run;
    // Address that follows in the pattern that runs.
    wire [3:0] following = at_last && cyclic ? base : address + 4'd1;
    // A pattern runs in the next unit time, if this is the tick of RST.
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

endmodule
