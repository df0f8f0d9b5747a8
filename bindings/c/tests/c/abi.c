/* Version of the ABI, that of the header and that of the library. */
#include "expect.h"

int main(void)
{
    EXPECT(mrtl_abi(), MRTL_ABI);
    printf("ABI %d\n", MRTL_ABI);
    return 0;
}
