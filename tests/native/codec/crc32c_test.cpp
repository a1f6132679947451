#include "pfgeom/codec/crc32c.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace pfgeom {
namespace {

TEST(Crc32c, KnownAnswers) {  // RFC 3720, B.4
    std::vector<std::uint8_t> bytes(32, 0);
    EXPECT_EQ(crc32c(bytes), 0x8A9136AAU);
    bytes.assign(32, 0xFF);
    EXPECT_EQ(crc32c(bytes), 0x62A8AB43U);
    for (std::size_t i = 0; i < 32; ++i) bytes[i] = static_cast<std::uint8_t>(i);
    EXPECT_EQ(crc32c(bytes), 0x46DD794EU);
    constexpr std::string_view kDigits = "123456789";
    EXPECT_EQ(crc32c(std::vector<std::uint8_t>(kDigits.begin(), kDigits.end())), 0xE3069283U);
    EXPECT_EQ(crc32c({}), 0U);
}

}  // namespace
}  // namespace pfgeom
