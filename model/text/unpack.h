#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace armcal {

// The most bytes that `packed` ones may unpack to. Logs pack 2 to 50 times;
// what packs more than 200 times has been made to fill the memory.
std::uint64_t MostUnpacked(std::uint64_t packed);

// Unpacks whole frames of zstd or LZ4 to exactly `size` bytes in *bytes; false
// where they are damaged or of another size.
bool UnpackZstd(std::string_view packed, std::uint64_t size,
                std::string* bytes);
bool UnpackLz4(std::string_view packed, std::uint64_t size, std::string* bytes);

// Whether a frame of zstd begins here, and the size that it says.
bool IsZstd(std::string_view bytes);
std::uint64_t SizeOfZstd(std::string_view packed);  // 0 where it is not said

}  // namespace armcal
