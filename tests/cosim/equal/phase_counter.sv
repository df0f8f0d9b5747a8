// The phase counter with the names of the model.
module phase_counter (
    input  logic        clk,
    input  logic        rst,
    input  logic        secondary,
    input  logic [16:0] modulus,
    output logic [16:0] phase = '0,
    output logic [16:0] place = '0,
    output logic        fault = 1'b0,
    output logic        square_wave,
    output logic        take
);
    logic [2:0]  sync_secondary = 3'b111;
    logic [17:0] elapsed = '0;
    logic        crossed = 1'b0;

    wire [17:0] period = modulus == 0 ? 18'h20000 : {1'b0, modulus};
    wire [17:0] seen = phase >= 2 ? phase - 18'd2 : phase + period - 18'd2;
    wire rises = sync_secondary[2:1] == 2'b01;
    wire early = rises && crossed && elapsed < period - period / 4;
    wire overdue = elapsed > period + period / 4;

    assign square_wave = phase < period / 2;
    assign take = seen[16:0] == 0 && (crossed || fault);

    always_ff @(posedge clk) begin
        phase <= phase + 18'd1 >= period ? 17'd0 : phase + 17'd1;
        sync_secondary <= {sync_secondary[1], sync_secondary[0], secondary};
        if (rises) place <= seen[16:0];
        if (rises) elapsed <= 1;
        else if (!overdue) elapsed <= elapsed + 1;
        crossed <= crossed | rises;
        fault <= early || overdue || (fault && seen[16:0] != 0);
        if (rst) begin
            phase <= 0;
            sync_secondary <= '1;
            place <= 0;
            elapsed <= 0;
            crossed <= 0;
            fault <= 0;
        end
    end
endmodule
