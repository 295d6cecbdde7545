#include "model/log_files/mat_reader.h"

#include <gtest/gtest.h>
#include <hdf5/serial/hdf5.h>
#include <zlib.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "model/log_files/log_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::mat_reader_test {

LogReaderOptions Options() {
  LogReaderOptions options;
  options.joint_names = {"joint1", "joint2"};
  return options;
}

std::string Bytes(const std::string& name) {
  std::ostringstream bytes;
  bytes << std::ifstream(FORMATS_DIR "/" + name, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string Refusal(const std::string& bytes) {
  const std::string path = WriteFile(bytes, "log.mat");
  return MessageOf<InputError>(path, [&] { ReadWholeLog(path, Options()); });
}

// SciPy wrote v4 and v5, h5py v7.3, of the log in data/log_formats. That of v5
// is a structure, compressed, whose columns have names and are the other way
// round.
TEST(MatReader, ReadsWhatOthersWrite) {
  const Log csv = ReadWholeLog(DATA_DIR "/log_formats/log.csv", Options());
  for (const char* name : {"v4.mat", "v5.mat", "v73.mat"}) {
    const Log log =
        ReadWholeLog(FORMATS_DIR "/" + std::string(name), Options());
    ASSERT_EQ(log.size(), csv.size()) << name;
    EXPECT_TRUE(log.t == csv.t && log.q == csv.q && log.tau == csv.tau) << name;
  }
}

TEST(MatReader, TellsFilesByTheirFirstBytes) {
  EXPECT_TRUE(IsMatFile("MATLAB 5.0 MAT-file"));
  EXPECT_TRUE(IsMatFile(Bytes("v4.mat").substr(0, 24)));
  // Big endian: 1000, 3 rows, 1 column, real, a name of 2 bytes.
  EXPECT_TRUE(IsMatFile(
      std::string("\0\0\x3\xe8\0\0\0\3\0\0\0\1\0\0\0\0\0\0\0\2", 20)));
  EXPECT_FALSE(IsMatFile("t,q1,q2,tau1,tau2\n0.0,1"));
  EXPECT_FALSE(IsMatFile(std::string(24, '\0')));
  EXPECT_FALSE(IsMatFile(""));
}

TEST(MatReader, RefusesFilesThatAreCutOff) {
  for (const char* name : {"v4.mat", "v5.mat", "v73.mat"}) {
    const std::string whole = Bytes(name);
    for (size_t size = whole.size() - 1; size > 200; size -= whole.size() / 9) {
      EXPECT_NE(Refusal(whole.substr(0, size)), "") << name << " " << size;
    }
  }
  const std::string v5 = Bytes("v5.mat");
  EXPECT_EQ(Refusal(v5.substr(0, v5.size() - 1)),
            "FILE: is cut off: expected a whole MAT-file");
}

// A file of v7.3 whose positions are as `change` stores them, by their place,
// the group that holds them and their extent.
std::string Moved(const std::function<void(hid_t file, hid_t extent)>& change) {
  const std::string path = WriteFile(Bytes("v73.mat"), "log.mat");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t positions = H5Dopen2(file, "q", H5P_DEFAULT);
  const hid_t extent = H5Dget_space(positions);
  H5Dclose(positions);
  H5Ldelete(file, "q", H5P_DEFAULT);
  change(file, extent);
  H5Sclose(extent);
  H5Fclose(file);
  return MessageOf<InputError>(path, [&] { ReadWholeLog(path, Options()); });
}

// HDF5 took 21 GB for one like it, which fuzzing found.
TEST(MatReader, RefusesMorePiecesThanThereAreBytes) {
  const auto refusal = [](hsize_t rows) {
    return Moved([=](hid_t file, hid_t) {
      const hsize_t size[] = {2, rows}, piece[] = {1, 1};
      const hid_t extent = H5Screate_simple(2, size, nullptr);
      const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
      H5Pset_chunk(how, 2, piece);
      const hid_t positions = H5Dcreate2(file, "q", H5T_NATIVE_DOUBLE, extent,
                                         H5P_DEFAULT, how, H5P_DEFAULT);
      const hsize_t one[] = {1, 1}, first[] = {0, 0};
      const double value = 1;
      const hid_t memory = H5Screate_simple(2, one, nullptr);
      H5Sselect_hyperslab(extent, H5S_SELECT_SET, first, nullptr, one, nullptr);
      H5Dwrite(positions, H5T_NATIVE_DOUBLE, memory, extent, H5P_DEFAULT,
               &value);
      H5Sclose(memory);
      H5Dclose(positions);
      H5Pclose(how);
      H5Sclose(extent);
    });
  };
  const std::string refused =
      "FILE: variable q: is damaged: expected no more pieces than it has bytes";
  EXPECT_NE(refusal(4), refused);  // 8 bytes are stored
  EXPECT_EQ(refusal(5), refused);
}

// HDF5 copied what lay behind them, which fuzzing found: numbers in a header, a
// piece that its filter has not inflated, one that inflates to less.
TEST(MatReader, RefusesPiecesThatAreTooShort) {
  const auto refusal = [](unsigned skipped, const std::string& stored) {
    return Moved([=](hid_t file, hid_t) {
      const hsize_t size[] = {2, 100}, first[] = {0, 0};
      const hid_t extent = H5Screate_simple(2, size, nullptr);
      const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
      H5Pset_chunk(how, 2, size);
      H5Pset_deflate(how, 6);
      const hid_t positions = H5Dcreate2(file, "q", H5T_NATIVE_DOUBLE, extent,
                                         H5P_DEFAULT, how, H5P_DEFAULT);
      H5Dwrite_chunk(positions, H5P_DEFAULT, skipped, first, stored.size(),
                     stored.data());
      H5Dclose(positions);
      H5Pclose(how);
      H5Sclose(extent);
    });
  };
  const auto deflated = [](size_t bytes) {
    std::string text(1000, 0);
    const std::string zeros(bytes, 0);
    uLongf size = text.size();
    compress(reinterpret_cast<Bytef*>(text.data()), &size,
             reinterpret_cast<const Bytef*>(zeros.data()), zeros.size());
    return text.substr(0, size);
  };
  const std::string refused =
      "FILE: variable q: is damaged: expected as many bytes as its size takes";
  EXPECT_EQ(refusal(1, std::string(1592, 0)), refused);
  EXPECT_NE(refusal(1, std::string(1600, 0)), refused);
  EXPECT_EQ(refusal(0, deflated(1592)), refused);
  EXPECT_NE(refusal(0, deflated(1600)), refused);
  EXPECT_EQ(refusal(0, "not deflated"), refused);
}

TEST(MatReader, ReadsNoOtherFile) {
  const std::string refused =
      "FILE: variable q: lies in another file: expected numbers that are in "
      "this one";
  const std::string other = WriteFile(Bytes("v73.mat"), "other.mat");
  EXPECT_EQ(Moved([&](hid_t file, hid_t) {
              H5Lcreate_external(other.c_str(), "q", file, "q", H5P_DEFAULT,
                                 H5P_DEFAULT);
            }),
            refused);
  const auto store = [](hid_t file, hid_t extent, hid_t how) {
    H5Dclose(H5Dcreate2(file, "q", H5T_NATIVE_DOUBLE, extent, H5P_DEFAULT, how,
                        H5P_DEFAULT));
    H5Pclose(how);
  };
  EXPECT_EQ(Moved([&](hid_t file, hid_t extent) {
              const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
              H5Pset_external(how, other.c_str(), 0, H5F_UNLIMITED);
              store(file, extent, how);
            }),
            refused);
  EXPECT_EQ(Moved([&](hid_t file, hid_t extent) {
              const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
              H5Pset_virtual(how, extent, other.c_str(), "q", extent);
              store(file, extent, how);
            }),
            refused);
  // Within the file, a name may lead to another.
  EXPECT_EQ(Moved([&](hid_t file, hid_t) {
              H5Lcreate_soft("tau", file, "q", H5P_DEFAULT, H5P_DEFAULT);
            }),
            "");
}

TEST(MatReader, NoticesDamageOfWhatIsCompressed) {
  const std::string whole = Bytes("v5.mat");
  for (size_t at = 300; at < whole.size(); at += 41) {
    std::string damaged = whole;
    damaged[at] ^= 0x10;
    EXPECT_NE(Refusal(damaged), "") << at;
  }
}

TEST(MatReader, SaysWhichArraysThereAre) {
  std::string text = Bytes("v4.mat");
  // The name of the first variable, t.
  ASSERT_EQ(text.substr(20, 2), std::string("t\0", 2));
  text[20] = 'x';
  EXPECT_EQ(Refusal(text),
            "FILE: row 1: no time column: expected t, time, "
            "timestamp or __time; not recognised: 'x'");
}

}  // namespace armcal::mat_reader_test
