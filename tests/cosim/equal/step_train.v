// A pulse train in other words than the model's: names of its own, an active-low reset, and a step
// line that is low while the motor driver sees a step.
module step_train #(
    parameter HALF = 16,
    parameter NUMBER = 17
) (
    input  wire              ck,
    input  wire              rst_n,
    input  wire              go,
    input  wire [HALF-1:0]   half,
    input  wire [NUMBER-1:0] number,
    input  wire              back,
    output wire              line_n,
    output reg               dir = 1'b0,
    output wire              over
);
    reg [HALF-1:0]   half_q = 0;
    reg [NUMBER-1:0] to_go = 0;
    reg [HALF-1:0]   ticks = 0;
    reg              idle_n = 1'b1;

    wire [HALF-1:0] up = ticks + 1'b1;
    wire runs = |to_go && |half_q;
    wire edge_now = runs && up >= half_q;
    wire falls = edge_now && !idle_n;

    assign line_n = idle_n;
    assign over = to_go == 0 || (to_go == 1 && falls);

    always @(posedge ck) begin
        if (!rst_n) begin
            half_q <= 0;
            to_go <= 0;
            ticks <= 0;
            idle_n <= 1'b1;
            dir <= 1'b0;
        end else if (go) begin
            half_q <= half;
            to_go <= number;
            ticks <= 0;
            idle_n <= 1'b1;
            if (number != 0)
                dir <= back;
        end else begin
            ticks <= edge_now || !runs ? {HALF{1'b0}} : up;
            if (edge_now)
                idle_n <= !idle_n;
            if (falls)
                to_go <= to_go - 1'b1;
        end
    end
endmodule
