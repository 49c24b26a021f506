// Methods as a user writes them.
#include "bench/method.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace tarn::test {
namespace {

std::string message_of(const std::string& text) {
    try {
        parse_methods(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Methods, EveryRowOfTheTableIsAMethodByItsOwnName) {
    for (const Method& row : method_table()) {
        const Method method = parse_method(row.label);
        EXPECT_EQ(method.label, row.label);
        EXPECT_FALSE(method.sentence.empty()) << row.label;
        for (const Setting& setting : setting_table()) {
            EXPECT_EQ(setting.get(method.settings), setting.get(row.settings)) << row.label;
        }
        if (row.dial.empty()) continue;
        EXPECT_NO_THROW(find_setting(row.dial)) << row.label;
    }
}

TEST(Methods, SettingsFollowTheColon) {
    const Method method = parse_method("ris:candidates=7");
    EXPECT_EQ(method.settings.direct.candidates, 7);
    EXPECT_EQ(method.label, "ris:candidates=7");
}

TEST(Methods, ADialWithAValueIsNotTurned) {
    EXPECT_EQ(parse_method("ris").dial, "candidates");
    EXPECT_EQ(parse_method("ris:candidates=7").dial, "samples");
    EXPECT_EQ(parse_method("ris:candidates=7,samples=2").dial, "");
    EXPECT_EQ(parse_method("uniform").dial, "samples");
    EXPECT_EQ(parse_method("uniform:samples=2").dial, "");
    EXPECT_EQ(parse_method("restir-fast:candidates=7").dial, "");
}

TEST(Methods, CommasSeparateMethodsAndSettings) {
    const auto methods = parse_methods("ris:candidates=8,direct=ris,uniform,ris");
    ASSERT_EQ(methods.size(), 3u);
    EXPECT_EQ(methods[0].label, "ris:candidates=8,direct=ris");
    EXPECT_EQ(methods[1].label, "uniform");
    EXPECT_EQ(methods[2].label, "ris");
}

TEST(Methods, MessagesNameWhatIsWrongAndWhatThereIs) {
    EXPECT_NE(message_of("nobody").find("'nobody' is no method; there are: uniform"), std::string::npos);
    EXPECT_NE(message_of("ris:candles=3").find("'candles' is no setting"), std::string::npos);
    EXPECT_NE(message_of("ris:candidates").find("not setting=value"), std::string::npos);
    EXPECT_NE(message_of("ris:candidates=0").find("candidates"), std::string::npos);
    EXPECT_NE(message_of("ris,ris").find("named twice"), std::string::npos);
    EXPECT_NE(message_of("").find("'' is no method"), std::string::npos);
}

TEST(Methods, AReferenceOfTheirOwnBouncesJudgesThem) {
    EXPECT_EQ(count_bounces(parse_methods("uniform,restir-fast")), 1);
    EXPECT_EQ(count_bounces(parse_methods("path,restir-gi,clean,clean-noisy")), 2);
    EXPECT_EQ(count_bounces(parse_methods("restir-gi:indirect-bounces=3")), 4);
    EXPECT_EQ(count_bounces(parse_methods("path:indirect=off")), 1);
    try {
        count_bounces(parse_methods("ris,path"));
        FAIL() << "direct and indirect light share no reference";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'ris' and 'path'"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace tarn::test
