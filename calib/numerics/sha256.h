#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's EVP_MD_CTX

namespace armcal {

// SHA-256 (FIPS 180-4), piece by piece.
class Sha256 {
 public:
  using Digest = std::array<unsigned char, 32>;

  Sha256();
  void Add(std::string_view bytes);
  Digest Value();  // once, at the end

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

Sha256::Digest Sha256Of(std::string_view bytes);
// As `sha256sum` prints it.
std::string HexText(const Sha256::Digest& digest);

// Of a file's bytes.
struct FileHash {
  std::string sha256;
  long bytes = 0;
};
// Throws InputError where the file cannot be read.
FileHash HashOfFile(const std::string& path);

}  // namespace armcal
