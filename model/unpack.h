#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace armcal {

// Unpacks whole frames of zstd or LZ4 to exactly `size` bytes in *bytes; false
// where they are damaged or of another size.
bool UnpackZstd(std::string_view packed, std::uint64_t size,
                std::string* bytes);
bool UnpackLz4(std::string_view packed, std::uint64_t size, std::string* bytes);

// Whether a frame of zstd begins here, and the size that it says.
bool IsZstd(std::string_view bytes);
std::uint64_t SizeOfZstd(std::string_view packed);  // 0 where it is not said

}  // namespace armcal
