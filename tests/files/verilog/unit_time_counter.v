// unit_time_counter: counts the reference clock, pulses RST once per unit time.
// Made by motion-rtl from the circuit of that name.

module unit_time_counter (
    input  wire       clk,
    input  wire       rst,     // Registers to their power-on values; memories stay.
    input  wire [3:0] period,  // Unit time in ticks, which the surrounding circuit keeps constant
                               // between two RST.
    output wire       unit_rst // RST: this is the last tick of the unit time.
);

    reg  [3:0] count = 4'd0; // Ticks since the unit time began.

    // count + 1: ticks of the unit time that are over after this one.
    wire [3:0] next = count + 4'd1;
    assign unit_rst = next >= period;

    always @(posedge clk)
        if (rst)
            count <= 4'd0;
        else if (unit_rst)
            count <= 4'd0;
        else
            count <= next;

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // The count starts again after RST.
        if (f_past_valid && !$past(rst))
            assert (!$past(unit_rst) || count == 4'd0);
        // Between two RST the count goes up by one and stays below T.
        if (f_past_valid && !$past(rst))
            assert ($past(unit_rst) ||
                (count == $past(count) + 4'd1 && $past(count) < count && count < $past(period)));
        // The count never reaches its greatest value.
        assert (count < 4'd15);
    end
`endif

endmodule
