// enable_counter: divides the reference clock: one tick of enable per period.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module enable_counter (
    input  wire       clk,
    input  wire       rst,    // Registers to their power-on values; memories stay.
    input  wire [3:0] period, // Ticks from one enable to the next; 0 counts as 1.
    output wire       enable  // High in the last tick of the period.
);

    reg  [3:0] count = 4'd0; // Ticks since the period began.

    // count + 1: ticks of the period, including this one.
    wire [3:0] next = count + 4'd1;
    assign enable = next >= period;

    always @(posedge clk)
        if (rst)
            count <= 4'd0;
        else if (enable)
            count <= 4'd0;
        else
            count <= next;

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // enable is high in the last tick of a period, and only there.
        assert (!(enable ^ (count >= period - 4'd1 || period == 4'd0)));
        // A period begins after enable.
        if (f_past_valid && !$past(rst))
            assert (!$past(enable) || count == 4'd0);
        // Without enable the count goes up by one and stays below the period.
        if (f_past_valid && !$past(rst))
            assert ($past(enable) ||
                (count == $past(count) + 4'd1 &&
                 $past(count) < count &&
                 count < $past(period)));
        // The count never reaches its greatest value.
        assert (count < 4'd15);
    end
`endif

endmodule
