#define ARMCAL_INSTRUCTION_SET avx512
#define ARMCAL_LANES 8
#include "model/simd/kernel_table.inc"
