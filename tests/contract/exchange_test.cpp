// What a program of a released version sends, one of this version reads the same, and the other way round.
#include <gmock/gmock.h>
#include <google/protobuf/dynamic_message.h>

#include <memory>

#include "tests/contract/contract.h"
#include "tests/contract/random_message.h"

namespace kcs::contract {
namespace {

using namespace google::protobuf;

// The message as a program reads it that knows this type.
std::unique_ptr<Message> received(const Message& sent, const Message& type) {
  std::unique_ptr<Message> message(type.New());
  EXPECT_TRUE(message->ParseFromString(sent.SerializeAsString())) << sent.Utf8DebugString();
  return message;
}

std::string known_content(Message& message) {
  message.DiscardUnknownFields();
  return message.Utf8DebugString();
}

void exchange(const Message& released, const Message& present, std::mt19937_64& random) {
  const std::unique_ptr<Message> old(released.New());
  fill(*old, random);
  const std::string content = old->Utf8DebugString();
  const std::unique_ptr<Message> taken = received(*old, present);
  EXPECT_EQ(taken->Utf8DebugString(), content);

  add_future_fields(*taken, random);
  const std::string with_future = taken->Utf8DebugString();
  const std::unique_ptr<Message> back = received(*taken, released);
  const std::unique_ptr<Message> again = received(*back, present);
  EXPECT_EQ(again->Utf8DebugString(), with_future) << "what the older one does not know it passes on";
  EXPECT_EQ(known_content(*back), content) << "what the older one reads";
  EXPECT_EQ(known_content(*again), content) << "what this one reads of a newer one";
}

TEST(Exchange, WithEveryReleasedVersionKeepsEveryValue) {
  std::mt19937_64 random(1);
  int types = 0;
  for (const auto& file : released_files()) {
    SCOPED_TRACE(file);
    const Contract contract(read_release(file));
    DynamicMessageFactory factory;
    for (const FileDescriptor* part : contract.files()) {
      for (int i = 0; i < part->message_type_count(); ++i) {
        const Descriptor& released = *part->message_type(i);
        const Descriptor* const present = present_contract().FindMessageTypeByName(released.full_name());
        ASSERT_NE(present, nullptr) << released.full_name();
        SCOPED_TRACE(released.full_name());
        for (int round = 0; round < 20; ++round) {
          exchange(*factory.GetPrototype(&released), *MessageFactory::generated_factory()->GetPrototype(present),
                   random);
        }
        ++types;
      }
    }
  }
  EXPECT_GT(types, 50);
}

}  // namespace
}  // namespace kcs::contract
