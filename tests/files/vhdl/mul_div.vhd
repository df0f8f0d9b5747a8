-- mul_div: multiplies, adds and divides with remainder, one, two or all bits per tick.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity mul_div is
    port (
        clk          : in  std_logic;
        rst          : in  std_logic;            -- Registers to their power-on values; memories
                                                 -- stay.
        start        : in  std_logic;            -- Starts a calculation; ignored while busy.
        product_only : in  std_logic;            -- Skips the division: quotient is then the
                                                 -- product plus the addend.
        multiplicand : in  unsigned(5 downto 0); -- First factor.
        multiplier   : in  unsigned(3 downto 0); -- Second factor.
        addend       : in  unsigned(5 downto 0); -- Addend of the product. Product plus addend must
                                                 -- be below 2^Q.
        divisor      : in  unsigned(5 downto 0); -- Divisor of the sum; below 2^(Q - 1). A divisor
                                                 -- of 0 gives a quotient of all ones.
        quotient     : out unsigned(5 downto 0); -- Product so far; in the division, dividend bits
                                                 -- above and quotient bits below; at the end the
                                                 -- result.
        remainder    : out unsigned(5 downto 0); -- Remainder of the division.
        done         : out std_logic;            -- High if a result is new: quotient and remainder
                                                 -- are valid from this tick until the next start.
        busy         : out std_logic             -- A calculation is running; a start is ignored.
    );
end entity mul_div;

architecture rtl of mul_div is

    constant STATE_IDLE : unsigned(1 downto 0) := to_unsigned(0, 2);
    constant STATE_MULTIPLY : unsigned(1 downto 0) := to_unsigned(1, 2);
    constant STATE_DIVIDE : unsigned(1 downto 0) := to_unsigned(2, 2);

    signal state : unsigned(1 downto 0) := STATE_IDLE;              -- State of the sequence. 0 idle,
                                                                    -- 1 multiply, 2 divide.
    signal count : unsigned(5 downto 0) := (others => '0');         -- Ticks since the state began.
    signal undivided : std_logic := '0';                            -- product_only of the running
                                                                    -- calculation.
    signal shifted : unsigned(5 downto 0) := (others => '0');       -- First factor times the weight
                                                                    -- of the next multiplier bit.
    signal factor : unsigned(3 downto 0) := (others => '0');        -- Remaining bits of the
                                                                    -- multiplier.
    signal by : unsigned(5 downto 0) := (others => '0');            -- Divisor of the running
                                                                    -- calculation.
    signal quotient_reg : unsigned(5 downto 0) := (others => '0');
    signal remainder_reg : unsigned(5 downto 0) := (others => '0');
    signal done_reg : std_logic := '0';

    signal take : std_logic;                     -- A start is accepted.
    signal partial : unsigned(5 downto 0);       -- Remainder with the next dividend bit appended.
    signal fits : std_logic;                     -- partial is at least the divisor: the quotient
                                                 -- bit is 1.
    signal last_part : unsigned(5 downto 0);
    signal last : std_logic;                     -- Last tick of the running state.
    signal complete : std_logic;                 -- The result is complete at the end of this tick.
    signal quotient_part : unsigned(5 downto 0);

begin

    quotient <= quotient_reg;
    remainder <= remainder_reg;
    done <= done_reg;

    busy <= state(0) or state(1);
    take <= start and not busy;
    partial <= shift_left(remainder, 1) or resize(unsigned'(0 => quotient(5)), 6);
    fits <= partial ?>= by;
    last_part <= to_unsigned(5, 6) when state(1) else to_unsigned(3, 6);
    last <= count ?= last_part;
    complete <= last and (state(1) or (state(0) and undivided));
    quotient_part <= shifted when factor(0) else (others => '0');

    process (clk)
    begin
        if rising_edge(clk) then
            if rst then
                state <= STATE_IDLE;
                count <= (others => '0');
                undivided <= '0';
                shifted <= (others => '0');
                factor <= (others => '0');
                by <= (others => '0');
                quotient_reg <= (others => '0');
                remainder_reg <= (others => '0');
                done_reg <= '0';
            else
                if take then
                    state <= STATE_MULTIPLY;
                elsif busy and last then
                    if state(0) and not undivided then
                        state <= STATE_DIVIDE;
                    else
                        state <= STATE_IDLE;
                    end if;
                end if;
                if take or last then
                    count <= (others => '0');
                elsif busy then
                    count <= count + 1;
                end if;
                if take then
                    undivided <= product_only;
                    shifted <= multiplicand;
                    factor <= multiplier;
                    by <= divisor;
                    quotient_reg <= addend;
                    remainder_reg <= (others => '0');
                else
                    if state(0) then
                        shifted <= shift_left(shifted, 1);
                        factor <= shift_right(factor, 1);
                    end if;
                    if state(1) then
                        quotient_reg <= shift_left(quotient, 1) or resize(unsigned'(0 => fits), 6);
                        if fits then
                            remainder_reg <= partial - by;
                        else
                            remainder_reg <= partial;
                        end if;
                    elsif state(0) then
                        quotient_reg <= quotient + quotient_part;
                    end if;
                end if;
                done_reg <= complete;
            end if;
        end if;
    end process;

end architecture rtl;

# Signals of mul_div whose names in VHDL are not those in the waves, for `motion-rtl compare --map`.
# The instance is called dut, as in the testbench.
