#include "model/text/unpack.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>

namespace armcal {

std::uint64_t MostUnpacked(std::uint64_t packed) {
  constexpr std::uint64_t kAlways = 64 << 20, kMost = std::uint64_t{8} << 30;
  return kAlways + std::min(packed, kMost / 200) * 200;
}

bool UnpackZstd(std::string_view packed, std::uint64_t size,
                std::string* bytes) {
  bytes->resize(size);
  return ZSTD_decompress(bytes->data(), size, packed.data(), packed.size()) ==
         size;
}

bool UnpackLz4(std::string_view packed, std::uint64_t size,
               std::string* bytes) {
  bytes->resize(size);
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) {
    return false;
  }
  std::uint64_t in = 0, out = 0;
  size_t left = 1;  // what it wants next; 0 at the end of a frame
  while (left != 0 || in < packed.size()) {
    size_t give = packed.size() - in, take = size - out;
    left = LZ4F_decompress(context, bytes->data() + out, &take,
                           packed.data() + in, &give, nullptr);
    if (LZ4F_isError(left) || (give == 0 && take == 0)) break;
    in += give;
    out += take;
  }
  LZ4F_freeDecompressionContext(context);
  return left == 0 && in == packed.size() && out == size;
}

bool IsZstd(std::string_view bytes) {
  return bytes.substr(0, 4) == "\x28\xb5\x2f\xfd";
}

std::uint64_t SizeOfZstd(std::string_view packed) {
  const auto size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  return size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN
             ? 0
             : size;
}

}  // namespace armcal
