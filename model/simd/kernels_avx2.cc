#define ARMCAL_INSTRUCTION_SET avx2
#define ARMCAL_LANES 4
#include "model/simd/kernel_table.inc"
