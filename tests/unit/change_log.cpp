// The log of changes against the simplest there is: a reader's copy of a table, refreshed by what the log
// names, is the table.
#include "world/change_log.h"

#include <gtest/gtest.h>

#include <array>

#include "support/draws.h"

namespace tarn {
namespace {

using test::Draws;
using Ranges = std::vector<IndexRange>;

TEST(ChangeLog, RangesAreMergedInOrder) {
    EXPECT_EQ(merge_ranges({}), Ranges{});
    EXPECT_EQ(merge_ranges({{5, 5}, {0, 0}}), Ranges{}) << "empty ones";
    EXPECT_EQ(merge_ranges({{7, 9}, {1, 3}}), (Ranges{{1, 3}, {7, 9}}));
    EXPECT_EQ(merge_ranges({{3, 5}, {1, 3}}), (Ranges{{1, 5}})) << "they touch";
    EXPECT_EQ(merge_ranges({{1, 9}, {2, 3}, {8, 11}}), (Ranges{{1, 11}})) << "one within, one over the end";
    EXPECT_EQ(merge_ranges({{4, 5}, {9, 9}, {0, 1}}, 3), (Ranges{{0, 5}})) << "a gap of 3";
    EXPECT_EQ(merge_ranges({{4, 5}, {0, 1}}, 2), (Ranges{{0, 1}, {4, 5}}));
    EXPECT_EQ(merge_ranges({{0, 0xfffffffeu}, {0xffffffffu, 0xffffffffu}}, 32), (Ranges{{0, 0xfffffffeu}}));
}

TEST(ChangeLog, ANewReaderIsToldOfEverythingAndThenOfNothing) {
    ChangeLog log;
    ChangeLog::Cursor reader;
    EXPECT_TRUE(log.has_news(reader)) << "even of a log without updates";
    EXPECT_TRUE(log.read(reader).everything);
    EXPECT_FALSE(log.has_news(reader));
    EXPECT_TRUE(log.read(reader).empty());
    log.append({{2, 4}});
    ChangeLog::Cursor late;
    EXPECT_TRUE(log.read(late).everything);
    EXPECT_EQ(log.read(reader).ranges, (Ranges{{2, 4}}));
}

TEST(ChangeLog, SeveralUpdatesAreToldAsOne) {
    ChangeLog log;
    ChangeLog::Cursor reader;
    log.read(reader);
    log.append({{8, 9}, {2, 4}});
    log.append({});
    log.append({{4, 6}, {20, 21}});
    EXPECT_EQ(log.revision(), 3u);
    const Changes changes = log.read(reader);
    EXPECT_FALSE(changes.everything);
    EXPECT_EQ(changes.ranges, (Ranges{{2, 6}, {8, 9}, {20, 21}}));
    EXPECT_TRUE(log.read(reader).empty());
}

TEST(ChangeLog, AnUpdateThatWroteNothingIsNewsWithoutRanges) {
    ChangeLog log;
    ChangeLog::Cursor reader;
    log.read(reader);
    log.append({});
    EXPECT_TRUE(log.has_news(reader));
    EXPECT_TRUE(log.read(reader).empty());
    EXPECT_FALSE(log.has_news(reader));
}

TEST(ChangeLog, ReadersDoNotDisturbEachOther) {
    ChangeLog log;
    ChangeLog::Cursor often, seldom;
    log.read(often);
    log.read(seldom);
    for (std::uint32_t i = 0; i < 10; ++i) {
        log.append({{10 * i, 10 * i + 1}});
        EXPECT_EQ(log.read(often).ranges, (Ranges{{10 * i, 10 * i + 1}}));
        EXPECT_TRUE(log.read(often).empty());
    }
    EXPECT_EQ(log.read(seldom).ranges.size(), 10u);
}

TEST(ChangeLog, WhoMissedThatEverythingChangedIsToldSo) {
    ChangeLog log;
    ChangeLog::Cursor before, after;
    log.read(before);
    log.append({{1, 2}});
    log.append_everything();
    log.read(after);
    log.append({{5, 6}});
    EXPECT_TRUE(log.read(before).everything);
    EXPECT_EQ(log.read(after).ranges, (Ranges{{5, 6}}));
}

TEST(ChangeLog, WhatIsForgottenHasChangedEverything) {
    ChangeLog log(8);  // four updates of one range
    ChangeLog::Cursor here, gone;
    log.read(gone);
    log.append({{0, 1}});
    log.read(here);
    for (std::uint32_t i = 0; i < 4; ++i) log.append({{2 + 2 * i, 3 + 2 * i}});
    EXPECT_EQ(log.read(here).ranges.size(), 4u);
    EXPECT_TRUE(log.read(gone).everything);
}

TEST(ChangeLog, TheLatestUpdateIsRememberedWhateverItsSize) {
    ChangeLog log(2);
    ChangeLog::Cursor reader, late;
    log.read(late);
    log.append({{0, 1}});
    log.read(reader);
    log.append({{0, 1}, {2, 3}, {4, 5}, {6, 7}});
    EXPECT_EQ(log.read(reader).ranges.size(), 4u);
    EXPECT_TRUE(log.read(late).everything);
}

TEST(ChangeLog, ACursorOfANewerTableStartsAnew) {
    ChangeLog older, newer;
    newer.append({});
    newer.append({});
    ChangeLog::Cursor reader;
    newer.read(reader);
    EXPECT_TRUE(older.read(reader).everything);
}

// ---- Copies of a table
// ------------------------------------------------------------------------------------------

// A copy and how it is kept: by the log, or, wrongly, by what the latest update wrote alone.
struct Copy {
    void refresh(const std::vector<int>& table, const Changes& changes) {
        if (changes.everything) cells = table;
        for (const IndexRange& range : changes.ranges) {
            for (std::uint32_t i = range.first; i < range.last; ++i) cells[i] = table[i];
        }
    }

    ChangeLog::Cursor cursor;
    std::vector<int> cells;
};

// Writes the table at random, with four readers who look every so often. Returns how many copies were stale.
int count_stale_copies(bool by_the_latest_alone) {
    Draws draws(4);
    ChangeLog log(200);
    std::vector<int> table(100);
    std::array<Copy, 4> readers;
    const std::array<std::uint32_t, 4> every = {1, 2, 7, 60};
    int stale = 0;
    for (int step = 0; step < 2000; ++step) {
        Ranges written;
        if (draws.bits() % 50u == 0u) {
            table.assign(80 + draws.bits() % 40u, step);
            log.append_everything();
        } else {
            for (std::uint32_t i = draws.bits() % 4u; i > 0; --i) {
                const std::uint32_t first = draws.bits() % std::uint32_t(table.size());
                const std::uint32_t last = std::min(std::uint32_t(table.size()), first + draws.bits() % 6u);
                for (std::uint32_t cell = first; cell < last; ++cell) ++table[cell];
                written.push_back({first, last});
            }
            log.append(written);
        }
        for (std::size_t r = 0; r < readers.size(); ++r) {
            if (draws.bits() % every[r] != 0u) continue;
            Changes changes = log.read(readers[r].cursor);
            if (by_the_latest_alone && !changes.everything) changes.ranges = merge_ranges(written);
            readers[r].refresh(table, changes);
            stale += readers[r].cells != table;
        }
    }
    return stale;
}

TEST(ChangeLog, CopiesThatFollowItAreTheTable) {
    EXPECT_EQ(count_stale_copies(false), 0);
}

TEST(ChangeLog, NegativeControlCopiesThatFollowTheLatestUpdateAloneAreNot) {
    EXPECT_GT(count_stale_copies(true), 100);
}

}  // namespace
}  // namespace tarn
