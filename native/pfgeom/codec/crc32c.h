// CRC-32C: finds accidents, not attackers.
// Source: Castagnoli, Bräuer, Herrmann, "Optimization of cyclic redundancy-check codes with 24 and 32 parity
// bits", IEEE Trans. Communications 41(6), 1993; parameters as in RFC 3720.
#pragma once

#include <cstdint>
#include <span>

namespace pfgeom {

std::uint32_t crc32c(std::span<const std::uint8_t> bytes);

}  // namespace pfgeom
