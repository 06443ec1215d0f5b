// Which changes of a contract break it.
#include "tests/contract/breaks.h"

#include <gmock/gmock.h>
#include <google/protobuf/compiler/parser.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "tests/contract/contract.h"

namespace kcs::contract {
namespace {

using namespace google::protobuf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FileDescriptorSet parse(const std::string& declarations) {
  const std::string text = "syntax = \"proto3\"; package p; " + declarations;
  io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
  io::Tokenizer tokenizer(&stream, nullptr);
  FileDescriptorSet files;
  files.add_file()->set_name("p.proto");
  EXPECT_TRUE(compiler::Parser().Parse(&tokenizer, files.mutable_file(0))) << text;
  return files;
}

std::vector<std::string> breaks_between(const std::string& released, const std::string& present) {
  const Contract before(parse(released)), after(parse(present));
  return breaks(*before.files().front(), after.pool());
}

struct Change {
  std::string name;
  std::string released, present;
  std::string place, how, remedy;
};
void PrintTo(const Change& change, std::ostream* out) { *out << change.name; }

class BreakingChange : public ::testing::TestWithParam<Change> {};

TEST_P(BreakingChange, IsNamedWithItsRemedy) {
  const Change& change = GetParam();
  EXPECT_THAT(breaks_between(change.released, change.released), IsEmpty());
  EXPECT_THAT(breaks_between(change.released, change.present),
              ElementsAre(change.place + ": " + change.how + "; " + change.remedy));
}

const std::string kField = "leave the field of number 1 as it was, and add another one";
const std::string kStays = "what was released stays: bring it back, and mark it deprecated if it is no more use";
const std::string kMethods = "message A {} message B {} service S { rpc M(";

INSTANTIATE_TEST_SUITE_P(
    All, BreakingChange,
    ::testing::Values(
        Change{"FieldGone", "message A { int32 x = 1; }", "message A {}", "p.A.x", "the field of number 1 is gone",
               "reserve both: reserved 1; reserved \"x\";"},
        Change{"NumberReservedButNotName", "message A { int32 x = 1; }", "message A { reserved 1; }", "p.A.x",
               "the field of number 1 is gone", "reserve both: reserved 1; reserved \"x\";"},
        Change{"NumberUsedAgain", "message A { int32 x = 1; }", "message A { int32 z = 1; }", "p.A.x",
               "its name was x and is z", kField},
        Change{"ReservedNumberUsed", "message A { reserved 1; }", "message A { int32 x = 1; }", "p.A.x",
               "the number 1 was reserved", "use the next free number"},
        Change{"Type", "message A { int32 x = 1; }", "message A { int64 x = 1; }", "p.A.x",
               "its type was int32 and is int64", kField},
        Change{"TypeOfMessage", "message A { B x = 1; } message B {} message C {}",
               "message A { C x = 1; } message B {} message C {}", "p.A.x", "its type was p.B and is p.C", kField},
        Change{"Count", "message A { string x = 1; }", "message A { repeated string x = 1; }", "p.A.x",
               "its count was one and is repeated", kField},
        Change{"Presence", "message A { int32 x = 1; }", "message A { optional int32 x = 1; }", "p.A.x",
               "its count was one and is one that can be absent", kField},
        Change{"Packing", "message A { repeated int32 x = 1; }", "message A { repeated int32 x = 1 [packed = false]; }",
               "p.A.x", "its packing was packed and is not packed", kField},
        Change{"IntoOneof", "message A { B x = 1; } message B {}",
               "message A { oneof o { B x = 1; B y = 2; } } message B {}", "p.A.x", "its oneof was none and is o",
               kField},
        Change{"NameInJson", "message A { int32 x = 1; }", "message A { int32 x = 1 [json_name = \"X\"]; }", "p.A.x",
               "its JSON name was x and is X", kField},
        Change{"MessageGone", "message A {} message B {}", "message A {}", "p.B", "the message is gone", kStays},
        Change{"NestedField", "message A { message B { int32 x = 1; } }", "message A { message B { bool x = 1; } }",
               "p.A.B.x", "its type was int32 and is bool", kField},
        Change{"MapValue", "message A { map<string, int32> x = 1; }", "message A { map<string, bool> x = 1; }",
               "p.A.XEntry.value", "its type was int32 and is bool",
               "leave the field of number 2 as it was, and add another one"},
        Change{"EnumGone", "enum E { Z = 0; }", "", "p.E", "the enum is gone", kStays},
        Change{"ValueGone", "enum E { Z = 0; V = 1; }", "enum E { Z = 0; }", "p.V", "the value 1 is gone",
               "reserve both: reserved 1; reserved \"V\";"},
        Change{"ValueRenumbered", "enum E { Z = 0; V = 1; }", "enum E { Z = 0; V = 2; }", "p.V",
               "its number was 1 and is 2", "give it its number again"},
        Change{"NestedValue", "message A { enum E { Z = 0; V = 1; } }", "message A { enum E { Z = 0; V = 2; } }",
               "p.A.V", "its number was 1 and is 2", "give it its number again"},
        Change{"ReservedValueUsed", "enum E { Z = 0; reserved 1; }", "enum E { Z = 0; V = 1; }", "p.V",
               "the number 1 was reserved", "use the next free number"},
        Change{"ServiceGone", kMethods + "A) returns (A); }", "message A {} message B {}", "p.S", "the service is gone",
               kStays},
        Change{"MethodGone", kMethods + "A) returns (A); }", "message A {} message B {} service S {}", "p.S.M",
               "the method is gone", kStays},
        Change{"Request", kMethods + "A) returns (A); }", kMethods + "B) returns (A); }", "p.S.M",
               "it was (p.A) returns (p.A) and is (p.B) returns (p.A)", "leave it as it was, and add another method"},
        Change{"Response", kMethods + "A) returns (A); }", kMethods + "A) returns (B); }", "p.S.M",
               "it was (p.A) returns (p.A) and is (p.A) returns (p.B)", "leave it as it was, and add another method"},
        Change{"RequestStream", kMethods + "A) returns (A); }", kMethods + "stream A) returns (A); }", "p.S.M",
               "it was (p.A) returns (p.A) and is (stream p.A) returns (p.A)",
               "leave it as it was, and add another method"},
        Change{"ResponseStream", kMethods + "A) returns (A); }", kMethods + "A) returns (stream A); }", "p.S.M",
               "it was (p.A) returns (p.A) and is (p.A) returns (stream p.A)",
               "leave it as it was, and add another method"}),
    [](const auto& test) { return test.param.name; });

TEST(Contract, MayGrow) {
  EXPECT_THAT(breaks_between("message A { int32 x = 1; } enum E { Z = 0; } service S {}",
                             "message A { int32 x = 1; string y = 2; oneof o { B b = 3; } } message B {} "
                             "enum E { Z = 0; V = 1; } service S { rpc M(A) returns (stream B); } service T {}"),
              IsEmpty());
}

TEST(Contract, MayLoseWhatItReserves) {
  EXPECT_THAT(breaks_between("message A { int32 x = 1; } enum E { Z = 0; V = 1; }",
                             "message A { reserved 1; reserved \"x\"; } enum E { Z = 0; reserved 1; reserved \"V\"; }"),
              IsEmpty());
}

TEST(Contract, IsComparedToItsEnd) {
  EXPECT_THAT(breaks_between("message A { int32 x = 1; bool y = 2; } enum E { Z = 0; }", "message A { int64 z = 1; }"),
              ElementsAre(HasSubstr("p.A.x"), HasSubstr("p.A.y"), HasSubstr("p.E")));
}

}  // namespace
}  // namespace kcs::contract
