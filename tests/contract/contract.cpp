#include "tests/contract/contract.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "google/rpc/error_details.pb.h"
#include "kcs/stored/v1/request.pb.h"
#include "kcs/v1/machine.pb.h"

namespace kcs::contract {

using google::protobuf::DescriptorPool;
using google::protobuf::FileDescriptorProto;
using google::protobuf::FileDescriptorSet;

Contract::Contract(const FileDescriptorSet& files) {
  for (const FileDescriptorProto& file : files.file()) {
    files_.push_back(pool_.BuildFile(file));
    if (files_.back() == nullptr) throw std::runtime_error(file.name() + " does not compile; see the log of protobuf");
  }
}

std::vector<std::filesystem::path> released_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(KCS_SOURCE "/tests/contract/released")) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

FileDescriptorSet read_release(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  FileDescriptorSet files;
  if (!stream || !files.ParseFromIstream(&stream) || files.file().empty()) {
    throw std::runtime_error(file.string() + " is no contract that tests/contract/release.sh wrote: take it from git");
  }
  return files;
}

const DescriptorPool& present_contract() {
  // A file of the contract is linked, and so in the pool, only if something of it is used.
  google::rpc::RequestInfo::descriptor();
  stored::v1::Request::descriptor();
  v1::Run::descriptor();
  return *DescriptorPool::generated_pool();
}

}  // namespace kcs::contract
