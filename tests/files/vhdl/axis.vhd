-- pattern_memory: direction and half-period per unit time, for one axis.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity pattern_memory is
    generic (
        AXIS : natural range 0 to 7 := 0
    );
    port (
        clk               : in  std_logic;
        rst               : in  std_logic;            -- Registers to their power-on values;
                                                      -- memories stay.
        read              : in  std_logic;            -- Reads the word at address into the output
                                                      -- registers.
        blank             : in  std_logic;            -- Puts "no pulse" into the output registers;
                                                      -- the direction stays. read has priority.
        address           : in  unsigned(1 downto 0); -- Address of the next unit time.
        write             : in  std_logic;            -- Writes a word of the axis with the number
                                                      -- write_axis.
        write_axis        : in  unsigned(2 downto 0); -- Number of the axis to write.
        write_address     : in  unsigned(1 downto 0); -- Address to write.
        write_half_period : in  unsigned(3 downto 0); -- Half-period to write, in ticks; 0 for no
                                                      -- pulse.
        write_direction   : in  std_logic;            -- Direction to write; high counts down.
        half_period       : out unsigned(3 downto 0); -- Half-period of the current unit time, in
                                                      -- ticks; 0 for no pulse.
        direction         : out std_logic             -- Direction of the current unit time; high
                                                      -- counts down.
    );
end entity pattern_memory;

architecture rtl of pattern_memory is

    type half_periods_words is array (0 to 3) of unsigned(3 downto 0);
    -- Half-periods, one word per unit time.
    signal half_periods : half_periods_words := (x"0", x"9", others => (others => '0'));

    type directions_words is array (0 to 3) of unsigned(0 downto 0);
    -- Directions, one bit per unit time.
    signal directions : directions_words := (others => (others => '0'));

    signal half_period_reg : unsigned(3 downto 0) := (others => '0');
    signal direction_reg : std_logic := '0';

    signal selected : std_logic; -- A word of this axis is written.
    signal clear : std_logic;    -- The output becomes "no pulse".

begin

    half_period <= half_period_reg;
    direction <= direction_reg;

    selected <= write and (write_axis ?= AXIS);
    clear <= blank and not read;

    process (clk)
    begin
        if rising_edge(clk) then
            if selected then
                half_periods(to_integer(write_address)) <= write_half_period;
            end if;
        end if;
    end process;

    process (clk)
    begin
        if rising_edge(clk) then
            if selected then
                directions(to_integer(write_address)) <= unsigned'(0 => write_direction);
            end if;
        end if;
    end process;

    process (clk)
    begin
        if rising_edge(clk) then
            if rst then
                half_period_reg <= (others => '0');
                direction_reg <= '0';
            else
                if clear then
                    half_period_reg <= (others => '0');
                elsif read then
                    half_period_reg <= half_periods(to_integer(address));
                end if;
                if read then
                    direction_reg <= directions(to_integer(address))(0);
                end if;
            end if;
        end if;
    end process;

end architecture rtl;

-- pulse_generator: toggles its pulse signal every half-period.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity pulse_generator is
    port (
        clk         : in  std_logic;
        rst         : in  std_logic;            -- Registers to their power-on values; memories
                                                -- stay.
        half_period : in  unsigned(3 downto 0); -- Half-period of the pulse signal in ticks; 0 for
                                                -- no pulse.
        unit_rst    : in  std_logic;            -- RST: high in the last tick of the unit time.
        pulse       : out std_logic             -- Pulse signal; the flip-flop 40 outputs it one
                                                -- tick later, except in the tick after RST.
    );
end entity pulse_generator;

architecture rtl of pulse_generator is

    signal count : unsigned(3 downto 0) := (others => '0'); -- 201: ticks since the last toggle.
    signal toggle : std_logic := '0';                       -- 202: level of the pulse signal since
                                                            -- the last toggle.

    signal next_s : unsigned(3 downto 0); -- count + 1: ticks since the last toggle, including this
                                          -- one.
    signal equal : std_logic;             -- 202: the half-period ends with this tick. The patent's
                                          -- name; the safe variant compares with >=.

begin

    next_s <= count + 1;
    equal <= next_s ?>= half_period;
    pulse <= (toggle xor equal) and (half_period ?/= 0);

    process (clk)
    begin
        if rising_edge(clk) then
            if rst then
                count <= (others => '0');
                toggle <= '0';
            else
                if equal or unit_rst then
                    count <= (others => '0');
                else
                    count <= next_s;
                end if;
                toggle <= pulse and not unit_rst;
            end if;
        end if;
    end process;

end architecture rtl;

-- sync_stage: flip-flop that loads the pulse signal, or 0 in the tick of RST.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity sync_stage is
    port (
        clk      : in  std_logic;
        rst      : in  std_logic; -- Registers to their power-on values; memories stay.
        pulse    : in  std_logic; -- Pulse signal of the pulse generator 20.
        unit_rst : in  std_logic; -- RST: high in the last tick of the unit time.
        step     : out std_logic  -- Step pulses to the motor driver; a step is a rising edge.
    );
end entity sync_stage;

architecture rtl of sync_stage is

    signal step_reg : std_logic := '0';

begin

    step <= step_reg;

    process (clk)
    begin
        if rising_edge(clk) then
            if rst then
                step_reg <= '0';
            else
                step_reg <= pulse and not unit_rst;
            end if;
        end if;
    end process;

end architecture rtl;

-- axis: pattern memory, pulse generator and sync stage of one axis.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity axis is
    port (
        clk               : in  std_logic;
        rst               : in  std_logic;            -- Registers to their power-on values;
                                                      -- memories stay.
        unit_rst          : in  std_logic;            -- RST: high in the last tick of the unit
                                                      -- time.
        read              : in  std_logic;            -- Reads the word at address for the next
                                                      -- unit time.
        blank             : in  std_logic;            -- The next unit time has no pulses.
        address           : in  unsigned(1 downto 0); -- Address of the next unit time.
        write             : in  std_logic;            -- Writes a word of the axis with the number
                                                      -- write_axis.
        write_axis        : in  unsigned(2 downto 0); -- Number of the axis to write.
        write_address     : in  unsigned(1 downto 0); -- Address to write.
        write_half_period : in  unsigned(3 downto 0); -- Half-period to write, in ticks; 0 for no
                                                      -- pulse.
        write_direction   : in  std_logic;            -- Direction to write; high counts down.
        step              : out std_logic;            -- Step pulses; a step is a rising edge.
        dir               : out std_logic             -- Direction; high counts down. Changes only
                                                      -- in the first tick of a unit time.
    );
end entity axis;

architecture rtl of axis is

    signal memory_half_period : unsigned(3 downto 0);
    signal memory_direction : std_logic;
    signal generator_pulse : std_logic;
    signal sync_step : std_logic;

begin

    dir <= memory_direction;
    step <= sync_step;

    memory : entity work.pattern_memory
        generic map (
            AXIS => 3
        )
        port map (
            clk               => clk,
            rst               => rst,
            read              => read,
            blank             => blank,
            address           => address,
            write             => write,
            write_axis        => write_axis,
            write_address     => write_address,
            write_half_period => write_half_period,
            write_direction   => write_direction,
            half_period       => memory_half_period,
            direction         => memory_direction
        );

    generator : entity work.pulse_generator
        port map (
            clk         => clk,
            rst         => rst,
            half_period => memory_half_period,
            unit_rst    => unit_rst,
            pulse       => generator_pulse
        );

    sync : entity work.sync_stage
        port map (
            clk      => clk,
            rst      => rst,
            pulse    => generator_pulse,
            unit_rst => unit_rst,
            step     => sync_step
        );

end architecture rtl;

# Signals of axis whose names in VHDL are not those in the waves, for `motion-rtl compare --map`.
# The instance is called dut, as in the testbench.

# GHDL's dumps have no arrays: delete these lines if yours have.
ignore = [
    "axis.memory.half_periods.*",
    "axis.memory.directions.*",
]

[signals]
"axis.generator.next" = "dut.generator.next_s"
