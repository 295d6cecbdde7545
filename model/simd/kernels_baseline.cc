#define ARMCAL_INSTRUCTION_SET baseline
#define ARMCAL_LANES 2
#include "model/simd/kernel_table.inc"
