-- A touch probe with its registers in a record.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity touch_probe is
    port (
        clk, rst          : in  std_logic;
        active, effect    : in  std_logic;
        position, present : in  signed(23 downto 0);
        taken             : out std_logic;
        measured          : out signed(23 downto 0)
    );
end entity touch_probe;

architecture rtl of touch_probe is

    type registers is record
        effect : std_logic;
        taken  : std_logic;
        place  : signed(23 downto 0);
    end record;
    constant POWER_ON : registers := (effect => '0', taken => '0', place => (others => '0'));

    signal q : registers := POWER_ON;
    signal first : std_logic;

    -- Copies for the dump, which has no records.
    signal effect_before : std_logic;
    signal latched : signed(23 downto 0);

begin

    first <= active and effect and not q.effect and not q.taken;
    taken <= q.taken;
    measured <= q.place when q.taken = '1' else present;

    effect_before <= q.effect;
    latched <= q.place;

    process (clk)
    begin
        if rising_edge(clk) then
            if rst = '1' then
                q <= POWER_ON;
            else
                q.effect <= effect;
                q.taken <= active and (q.taken or first);
                if first = '1' then
                    q.place <= position;
                end if;
            end if;
        end if;
    end process;

end architecture rtl;
