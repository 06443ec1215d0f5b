// Programs of every released version understand those of this one, and the other way round.
#include <gmock/gmock.h>

#include "tests/contract/breaks.h"
#include "tests/contract/contract.h"

namespace kcs::contract {
namespace {

using namespace google::protobuf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> all_breaks(const Contract& released, const DescriptorPool& present) {
  std::vector<std::string> found;
  for (const FileDescriptor* file : released.files()) {
    const std::vector<std::string> more = breaks(*file, present);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

TEST(ReleasedContract, IsKept) {
  ASSERT_FALSE(released_files().empty());
  for (const auto& file : released_files()) {
    EXPECT_THAT(all_breaks(Contract(read_release(file)), present_contract()), IsEmpty()) << file;
  }
}

// Every place of a release, changed one after the other, so that nothing of it is left out of the comparison.
class ChangedRelease : public ::testing::Test {
 protected:
  void expect_found(const std::string& name) {
    const Contract changed(files_);
    EXPECT_THAT(all_breaks(released_, changed.pool()), Contains(HasSubstr("." + name + ":")));
    ++changes_;
  }

  void renumber(EnumDescriptorProto& type) {
    for (EnumValueDescriptorProto& value : *type.mutable_value()) {
      if (value.number() == 0) continue;  // the first one has to be
      value.set_number(value.number() + 10'000);
      expect_found(value.name());
      value.set_number(value.number() - 10'000);
    }
  }

  void renumber(DescriptorProto& message) {
    for (FieldDescriptorProto& field : *message.mutable_field()) {
      if (message.options().map_entry()) continue;  // its numbers are given
      field.set_number(field.number() + 10'000);
      expect_found(field.name());
      field.set_number(field.number() - 10'000);
    }
    for (EnumDescriptorProto& type : *message.mutable_enum_type()) renumber(type);
    for (DescriptorProto& nested : *message.mutable_nested_type()) renumber(nested);
  }

  void change(ServiceDescriptorProto& service) {
    for (MethodDescriptorProto& method : *service.mutable_method()) {
      method.set_server_streaming(!method.server_streaming());
      expect_found(method.name());
      method.set_server_streaming(!method.server_streaming());
    }
  }

  FileDescriptorSet files_ = read_release(released_files().front());
  const Contract released_{files_};
  int changes_ = 0;
};

TEST_F(ChangedRelease, IsFoundWhereverItIs) {
  for (FileDescriptorProto& file : *files_.mutable_file()) {
    for (DescriptorProto& message : *file.mutable_message_type()) renumber(message);
    for (EnumDescriptorProto& type : *file.mutable_enum_type()) renumber(type);
    for (ServiceDescriptorProto& service : *file.mutable_service()) change(service);
  }
  EXPECT_GT(changes_, 200);
}

}  // namespace
}  // namespace kcs::contract
