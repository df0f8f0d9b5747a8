-- Functions of the shared library of motion-rtl 0.1.0 that its checkers call.
--
-- GHDL opens the library when it elaborates. A path with a slash begins in the directory of the
-- simulation. A name without one is sought in LD_LIBRARY_PATH and where the system has libraries.

library ieee;
use ieee.std_logic_1164.all;

package motion_rtl_pkg is

    -- Puts a model beside a design; returns the handle of the checker.
    impure function new_checker(
        version, circuit, settings, ports_hash, leave : string;
        from_power_on : boolean;
        waves, path : string
    ) return integer;

    -- Passes the ports at a rising edge.
    procedure edge(checker : integer; ports : std_ulogic_vector);

    -- Returns a handle, or 0 less the length of the text that says why there is none.
    impure function mrtl_vhpi_new( -- built by make -C bindings/c install PREFIX=DIR
        vhpi, from_power_on : integer;
        version, circuit, settings, ports_hash, leave, waves, path : string
    ) return integer;
    attribute foreign of mrtl_vhpi_new : function is
        "VHPIDIRECT lib/libmotion_rtl.so mrtl_vhpi_new";

    -- Returns the length of the text that there is to print.
    impure function mrtl_vhpi_edge( -- built by make -C bindings/c install PREFIX=DIR
        checker : integer; ports : std_ulogic_vector
    ) return integer;
    attribute foreign of mrtl_vhpi_edge : function is
        "VHPIDIRECT lib/libmotion_rtl.so mrtl_vhpi_edge";

    procedure mrtl_vhpi_text( -- built by make -C bindings/c install PREFIX=DIR
        checker : in integer; text : out string
    );
    attribute foreign of mrtl_vhpi_text : procedure is
        "VHPIDIRECT lib/libmotion_rtl.so mrtl_vhpi_text";

end package motion_rtl_pkg;

use std.env.finish;
use std.textio.all;

package body motion_rtl_pkg is

    procedure print(head : string; checker, length : integer) is
        variable said : string(1 to length);
    begin
        mrtl_vhpi_text(checker, said);
        write(output, head & said & LF);
    end procedure;

    impure function new_checker(
        version, circuit, settings, ports_hash, leave : string;
        from_power_on : boolean;
        waves, path : string
    ) return integer is
        variable checker : integer;
    begin
        checker := mrtl_vhpi_new(
            1, boolean'pos(from_power_on), version, circuit, settings, ports_hash,
            leave, waves, path);
        if checker <= 0 then
            print("FAIL: ", checker, 0 - checker);
            finish(1);
        end if;
        return checker;
    end function;

    procedure edge(checker : integer; ports : std_ulogic_vector) is
        variable length : integer;
    begin
        length := mrtl_vhpi_edge(checker, ports);
        if length > 0 then
            print("at time " & to_string(now, ns) & ": ", checker, length);
        end if;
    end procedure;

    -- Bodies that are never called, as VHDL asks for them.

    impure function mrtl_vhpi_new(
        vhpi, from_power_on : integer;
        version, circuit, settings, ports_hash, leave, waves, path : string
    ) return integer is
    begin
        return 0;
    end function;

    impure function mrtl_vhpi_edge(
        checker : integer; ports : std_ulogic_vector
    ) return integer is
    begin
        return 0;
    end function;

    procedure mrtl_vhpi_text(
        checker : in integer; text : out string
    ) is
    begin
        null;
    end procedure;

end package body motion_rtl_pkg;
