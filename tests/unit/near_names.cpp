// Names that a typing error may have meant.
#include "core/near_names.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tarn {
namespace {

const std::vector<std::string> NAMES = {"render", "reference", "report", "view", "bench"};

std::string suggest(const std::string& name) {
    return suggest_names(name, NAMES);
}

TEST(NearNames, OneLetterTooManyTooFewAnotherOrSwapped) {
    for (const char* name : {"renderr", "rener", "rendar", "redner", "ender"})
        EXPECT_EQ(suggest(name), "; did you mean 'render'?") << name;
    EXPECT_EQ(suggest("veiw"), "; did you mean 'view'?");
}

TEST(NearNames, AThirdOfTheLettersMayDiffer) {
    EXPECT_EQ(suggest("repart"), "; did you mean 'report'?");
    EXPECT_EQ(suggest("refrence"), "; did you mean 'reference'?");
}

TEST(NearNames, TheNearestComesFirst) {
    const std::vector<std::string> names = {"cornells", "corner", "cornell"};
    EXPECT_EQ(suggest_names("cornel", names), "; did you mean 'cornell' or 'corner' or 'cornells'?");
}

TEST(NearNames, NothingIsNear) {
    for (const char* name : {"", "x", "sandbox", "cathedral"}) EXPECT_EQ(suggest(name), "") << name;
}

}  // namespace
}  // namespace tarn
