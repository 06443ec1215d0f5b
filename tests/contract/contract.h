// A version of the contract: its files as they were compiled.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <filesystem>
#include <vector>

namespace kcs::contract {

class Contract {
 public:
  // Throws std::runtime_error if the files do not fit together.
  explicit Contract(const google::protobuf::FileDescriptorSet& files);

  const google::protobuf::DescriptorPool& pool() const { return pool_; }
  // With what they import, which comes first. They live as long as the contract.
  const std::vector<const google::protobuf::FileDescriptor*>& files() const { return files_; }

 private:
  google::protobuf::DescriptorPool pool_;
  std::vector<const google::protobuf::FileDescriptor*> files_;
};

// The files that release.sh has kept, one a version.
std::vector<std::filesystem::path> released_files();

// What such a file holds. Throws std::runtime_error if it cannot be read.
google::protobuf::FileDescriptorSet read_release(const std::filesystem::path& file);

// The contract of this build.
const google::protobuf::DescriptorPool& present_contract();

}  // namespace kcs::contract
