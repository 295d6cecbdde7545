#pragma once

#include <string>
#include <vector>

namespace armcal {

// Files on their way into a folder, where all of them take their places at one
// moment: whenever the run ends, by kill -9 too, who opens them finds all the
// old or all the new. (A power cut may lose what the system has not written.)
// They are written to a hidden folder beside their places; in these stand links
// for a moment,
//
//   calibration.json -> .armcal.RUN/now/calibration.json
//   .armcal.RUN/now  -> old, then new
//
// and it is `now` that is turned. In the end all are plain files again. Nothing
// else in the folder is touched. Where there are no links (FAT), files are
// renamed one after the other. Errors are std::filesystem::filesystem_error.
class StagedFiles {
 public:
  // `folder` exists, and no other run stages files there until this is gone.
  // Of names to which nothing is written the old files go.
  StagedFiles(const std::string& folder, std::vector<std::string> names);

  // Where to write a file to.
  std::string Path(const std::string& name) const;
  // All are written: puts links in their places.
  void Link();
  // The moment.
  void Switch();
  // Makes what links stand for plain files: the old ones before Switch(), which
  // undoes all. Throws nothing; what fails is left to Recover().
  void Settle();

  // Settles what runs have left that were killed.
  static void Recover(const std::string& folder);

 private:
  // False where the file system has no links.
  bool KeepOld() const;

  std::string folder_, stage_;
  std::vector<std::string> names_;
  bool linked_ = false;
};

}  // namespace armcal
