#pragma once

#include <Eigen/Core>
#include <memory>

namespace armcal {

// The triangular factor of a stretch of equations [A | y], by Householder QR of
// a chunk of rows at a time: the memory of a triangle and a chunk. Chunks begin
// at multiples of kChunkRows from its first row: it does not matter in which
// pieces rows come.
class LeafFactor {
 public:
  static constexpr long kChunkRows = 256;
  // From a column to the next; with a multiple of 256 all columns would share
  // few lines of the cache.
  static constexpr long kStride = kChunkRows + 8;

  explicit LeafFactor(int columns);
  LeafFactor(const LeafFactor& other);
  LeafFactor(LeafFactor&&) = default;
  LeafFactor& operator=(LeafFactor&&) = default;

  int columns() const { return static_cast<int>(triangle_.cols()) - 1; }
  long rows() const { return rows_; }
  void Clear();
  // Where the next rows go, the right side in the last column: at most room()
  // of them before Commit() says how many they were.
  double* Next() { return chunk_.get() + filled(); }
  long room() const { return kChunkRows - filled(); }
  void Commit(long rows);
  // Upper triangle of columns() + 1.
  Eigen::MatrixXd Triangle() const;

 private:
  struct Free {
    void operator()(double* chunk) const;
  };
  long filled() const { return rows_ % kChunkRows; }
  long size() const { return kStride * triangle_.cols(); }

  long rows_ = 0;
  Eigen::MatrixXd triangle_;  // of all full chunks
  std::unique_ptr<double[], Free> chunk_;
};

// The triangular factor of two triangles' equations together.
Eigen::MatrixXd MergeTriangles(const Eigen::MatrixXd& first,
                               const Eigen::MatrixXd& second);

}  // namespace armcal
