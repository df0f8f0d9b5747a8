// pattern_memory: direction and half-period per unit time, for one axis.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module pattern_memory #(
    parameter [2:0] AXIS = 3'd0
) (
    input  wire       clk,
    input  wire       rst,               // Registers to their power-on values; memories stay.
    input  wire       read,              // Reads the word at address into the output registers.
    input  wire       blank,             // Puts "no pulse" into the output registers; the direction
                                         // stays. read has priority.
    input  wire       address,           // Address of the next unit time.
    input  wire       write,             // Writes a word of the axis with the number write_axis.
    input  wire [2:0] write_axis,        // Number of the axis to write.
    input  wire       write_address,     // Address to write.
    input  wire [3:0] write_half_period, // Half-period to write, in ticks; 0 for no pulse.
    input  wire       write_direction,   // Direction to write; high counts down.
    output wire [3:0] half_period,       // Half-period of the current unit time, in ticks; 0 for no
                                         // pulse.
    output wire       direction          // Direction of the current unit time; high counts down.
);

    // Half-periods, one word per unit time.
    reg  [3:0] half_periods [0:1];
    integer half_periods_word;
    initial
        for (half_periods_word = 0; half_periods_word < 2; half_periods_word = half_periods_word + 1)
            half_periods[half_periods_word] = 4'd0;
`ifdef __ICARUS__
    // Words as wires, for dumps.
    generate
        genvar half_periods_at;
        for (half_periods_at = 0; half_periods_at < 2;
            half_periods_at = half_periods_at + 1) begin : half_periods_words
                wire [3:0] word = half_periods[half_periods_at];
        end
    endgenerate
`endif

    // Directions, one bit per unit time.
    reg  [0:0] directions [0:1];
    integer directions_word;
    initial
        for (directions_word = 0; directions_word < 2; directions_word = directions_word + 1)
            directions[directions_word] = 1'b0;
`ifdef __ICARUS__
    // Words as wires, for dumps.
    generate
        genvar directions_at;
        for (directions_at = 0; directions_at < 2;
            directions_at = directions_at + 1) begin : directions_words
                wire word = directions[directions_at];
        end
    endgenerate
`endif

    reg  [3:0] half_period_reg = 4'd0;
    reg        direction_reg = 1'b0;
    assign half_period = half_period_reg;
    assign direction = direction_reg;

    // A word of this axis is written.
    wire selected = write && write_axis == AXIS;
    // The output becomes "no pulse".
    wire clear = blank && !read;

    always @(posedge clk)
        if (selected)
            half_periods[write_address] <= write_half_period;

    always @(posedge clk)
        if (selected)
            directions[write_address] <= write_direction;

    always @(posedge clk)
        if (rst) begin
            half_period_reg <= 4'd0;
            direction_reg <= 1'b0;
        end else begin
            if (clear)
                half_period_reg <= 4'd0;
            else if (read)
                half_period_reg <= half_periods[address];
            if (read)
                direction_reg <= directions[address];
        end

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    reg past_read;
    reg past_blank;
    reg past_address;
    reg past_write;
    reg [2:0] past_write_axis;
    reg past_write_address;
    reg [3:0] past_write_half_period;
    reg past_write_direction;
    reg [3:0] past_half_period;
    reg past_direction;
    reg [3:0] past_net;
    reg past_net_2;
    always @(posedge clk) begin
        past_read <= read;
        past_blank <= blank;
        past_address <= address;
        past_write <= write;
        past_write_axis <= write_axis;
        past_write_address <= write_address;
        past_write_half_period <= write_half_period;
        past_write_direction <= write_direction;
        past_half_period <= half_period;
        past_direction <= direction;
        past_net <= half_periods[address];
        past_net_2 <= directions[address];
    end

    always @(posedge clk) begin
        // A read outputs the word that was stored before the edge.
        if (f_past_valid && !$past(rst))
            assert (!past_read || (half_period == past_net && !(direction ^ past_net_2)));
        // Blank without read sets half_period to 0 and keeps direction.
        if (f_past_valid && !$past(rst))
            assert (!(past_blank && !past_read) ||
                (half_period == 4'd0 && !(direction ^ past_direction)));
        // Without read and blank, half_period and direction keep their values.
        if (f_past_valid && !$past(rst))
            assert (past_read ||
                past_blank ||
                (half_period == past_half_period && !(direction ^ past_direction)));
        // Only a write to this axis changes a word, and only the word at write_address.
        if (f_past_valid && !$past(rst))
            assert (half_periods[past_address] ==
                (past_write && past_write_axis == AXIS && past_write_address == past_address ?
                 past_write_half_period : past_net) &&
                directions[past_address] ==
                (past_write && past_write_axis == AXIS && past_write_address == past_address ?
                 past_write_direction : past_net_2));
    end
`endif

endmodule

// pulse_generator: toggles its pulse signal every half-period.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module pulse_generator (
    input  wire       clk,
    input  wire       rst,         // Registers to their power-on values; memories stay.
    input  wire [3:0] half_period, // Half-period of the pulse signal in ticks; 0 for no pulse.
    input  wire       unit_rst,    // RST: high in the last tick of the unit time.
    output wire       pulse        // Pulse signal; the flip-flop 40 outputs it one tick later, except
                                   // in the tick after RST.
);

    reg  [3:0] count = 4'd0;  // 201: ticks since the last toggle.
    reg        toggle = 1'b0; // 202: level of the pulse signal since the last toggle.

    // count + 1: ticks since the last toggle, including this one.
    wire [3:0] next = count + 4'd1;
    // 202: the half-period ends with this tick. The patent's name; the safe variant compares with >=.
    wire equal = next >= half_period;
    assign pulse = (toggle ^ equal) && half_period != 4'd0;

    always @(posedge clk)
        if (rst) begin
            count <= 4'd0;
            toggle <= 1'b0;
        end else begin
            if (equal || unit_rst)
                count <= 4'd0;
            else
                count <= next;
            toggle <= pulse && !unit_rst;
        end

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // pulse is low if half_period is 0.
        assert (!(half_period == 4'd0 && pulse));
        // RST clears count and toggle.
        if (f_past_valid && !$past(rst))
            assert (!$past(unit_rst) || (count == 4'd0 && !toggle));
        // count stays below half_period or becomes 0.
        if (f_past_valid && !$past(rst))
            assert (count < $past(half_period) || count == 4'd0);
        // pulse toggles at the end of each half-period, and only there.
        if (f_past_valid && !$past(rst))
            assert ($past(half_period) == 4'd0 ||
                !($past(pulse) ^ $past(toggle) ^ ($past(count) >= $past(half_period) - 4'd1)));
        // toggle takes the value of pulse, except at RST.
        if (f_past_valid && !$past(rst))
            assert ($past(unit_rst) || !(toggle ^ $past(pulse)));
        // count never reaches its greatest value.
        assert (count < 4'd15);
    end
`endif

endmodule

// sync_stage: flip-flop that loads the pulse signal, or 0 in the tick of RST.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module sync_stage (
    input  wire clk,
    input  wire rst,      // Registers to their power-on values; memories stay.
    input  wire pulse,    // Pulse signal of the pulse generator 20.
    input  wire unit_rst, // RST: high in the last tick of the unit time.
    output wire step      // Step pulses to the motor driver; a step is a rising edge.
);

    reg  step_reg = 1'b0;
    assign step = step_reg;

    always @(posedge clk)
        if (rst)
            step_reg <= 1'b0;
        else
            step_reg <= pulse && !unit_rst;

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // step is low in the tick after RST.
        if (f_past_valid && !$past(rst))
            assert (!$past(unit_rst) || !step);
        // step is pulse one tick later, except in the tick after RST.
        if (f_past_valid && !$past(rst))
            assert ($past(unit_rst) || !(step ^ $past(pulse)));
    end
`endif

endmodule

// axis: pattern memory, pulse generator and sync stage of one axis.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module axis (
    input  wire       clk,
    input  wire       rst,               // Registers to their power-on values; memories stay.
    input  wire       unit_rst,          // RST: high in the last tick of the unit time.
    input  wire       read,              // Reads the word at address for the next unit time.
    input  wire       blank,             // The next unit time has no pulses.
    input  wire       address,           // Address of the next unit time.
    input  wire       write,             // Writes a word of the axis with the number write_axis.
    input  wire [2:0] write_axis,        // Number of the axis to write.
    input  wire       write_address,     // Address to write.
    input  wire [3:0] write_half_period, // Half-period to write, in ticks; 0 for no pulse.
    input  wire       write_direction,   // Direction to write; high counts down.
    output wire       step,              // Step pulses; a step is a rising edge.
    output wire       dir                // Direction; high counts down. Changes only in the first tick
                                         // of a unit time.
);

    wire [3:0] memory_half_period;
    wire       memory_direction;
    wire       generator_pulse;
    wire       sync_step;

    assign dir = memory_direction;
    assign step = sync_step;

    pattern_memory #(
        .AXIS(3'd0)
    ) memory (
        .clk               (clk),
        .rst               (rst),
        .read              (read),
        .blank             (blank),
        .address           (address),
        .write             (write),
        .write_axis        (write_axis),
        .write_address     (write_address),
        .write_half_period (write_half_period),
        .write_direction   (write_direction),
        .half_period       (memory_half_period),
        .direction         (memory_direction)
    );

    pulse_generator generator (
        .clk         (clk),
        .rst         (rst),
        .half_period (memory_half_period),
        .unit_rst    (unit_rst),
        .pulse       (generator_pulse)
    );

    sync_stage sync (
        .clk      (clk),
        .rst      (rst),
        .pulse    (generator_pulse),
        .unit_rst (unit_rst),
        .step     (sync_step)
    );

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    always @(posedge clk) begin
        // Step is low in the tick after RST.
        if (f_past_valid && !$past(rst))
            assert (!$past(unit_rst) || !sync_step);
        // dir changes only after a tick with read.
        if (f_past_valid && !$past(rst))
            assert ($past(read) || !(memory_direction ^ $past(memory_direction)));
    end
`endif

endmodule
