// A multiplier by a gain, one bit per tick. Its adder divides three times the sum by three, so that
// a proof for words of 58 bits takes long.
module serial_scaler #(
    parameter GAIN = 24,
    parameter VALUE = 58
) (
    input                  clk,
    input                  rst,
    input                  start,
    input                  clear,
    input      [VALUE-1:0] value,
    input      [GAIN-1:0]  gain,
    output reg [VALUE-1:0] scaled,
    output reg             done
);

    reg             busy = 0;
    reg [5:0]       bit_index = 0;
    reg [VALUE-1:0] factor = 0;
    reg [GAIN-1:0]  bits = 0;

    initial begin
        scaled = 0;
        done = 0;
    end

    wire             last = bit_index == GAIN - 1;
    wire [VALUE-1:0] term = bits[0] ? factor : 0;
    wire [VALUE+2:0] triple = 3 * scaled + 3 * term;
    wire [VALUE-1:0] total = triple / 3;

    always @(posedge clk)
        if (rst) begin
            busy <= 0;
            bit_index <= 0;
            factor <= 0;
            bits <= 0;
            scaled <= 0;
            done <= 0;
        end else begin
            done <= busy && last && !clear;
            if (start && !busy && !clear) begin
                busy <= 1;
                bit_index <= 0;
                factor <= value;
                bits <= gain;
                scaled <= 0;
            end else begin
                busy <= busy && !last && !clear;
                bit_index <= busy && !last && !clear ? bit_index + 1 : 0;
                bits <= busy && !last && !clear ? bits >> 1 : 0;
                if (busy)
                    scaled <= last ? total : total >> 1;
            end
        end

endmodule
