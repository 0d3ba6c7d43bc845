// Included first in each source on arm64: Eigen then multiplies and adds in two roundings, as it does on amd64. With
// this macro its NEON packets fuse both, whatever -ffp-contract says (Eigen/src/Core/arch/NEON/PacketMath.h, pmadd).
#pragma once

#include <arm_neon.h>  // its own pragmas would define the macro again

#undef __ARM_FEATURE_FMA
