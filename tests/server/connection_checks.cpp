// Limits of connections: which of them get a seat, and how long the server waits for a slow one.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>
#include <utility>

#include "server/connection.h"

namespace contort::server {
namespace {

// Two sockets that are connected: ours and the client's.
struct Pair {
  std::array<int, 2> ends{-1, -1};
  Pair() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0); }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
  ~Pair() {
    hang_up();
    ::close(ends[0]);
  }
  void hang_up() {
    if (ends[1] >= 0) ::close(std::exchange(ends[1], -1));
  }
  int ours() const { return ends[0]; }
  // Returns true if the bytes were accepted.
  bool send(const std::string& bytes) const {
    return ::send(ends[1], bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // Returns true if our end was shut down.
  bool is_over() const {
    char byte = 0;
    return ::recv(ends[1], &byte, 1, MSG_DONTWAIT | MSG_PEEK) == 0;
  }
  std::string received() const {
    std::string text(1 << 16, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::recv(ends[1], text.data(), text.size(), 0))));
    return text;
  }
};

using Seat = std::unique_ptr<Connections::Seat>;

Seat seat_of(Connections& all, const Pair& pair, const std::string& client) {
  Result<Seat> seat = all.enter(pair.ours(), client);
  EXPECT_TRUE(seat) << seat.issue().text;
  return std::move(seat).value();
}

Time at(int second) { return Time() + std::chrono::seconds(second); }

TEST(Connections, OfOneClientTheLongestWaitingMakesRoom) {
  Connections all(10, 2);
  Pair first, second, third, other;
  const Seat a = seat_of(all, first, "a"), b = seat_of(all, second, "a"), c = seat_of(all, other, "b");
  EXPECT_TRUE(a->waits_for_request(at(2)));
  b->waits_for_rest(at(1));
  EXPECT_TRUE(c->waits_for_request(at(0)));
  const Seat d = seat_of(all, third, "a");
  EXPECT_TRUE(second.is_over());
  EXPECT_FALSE(first.is_over());
  EXPECT_FALSE(other.is_over()) << "it is another client's";
  EXPECT_FALSE(b->waits_for_request(at(3))) << "it has to leave";
}

TEST(Connections, InAFullServerTheClientWithMostMakesRoom) {
  Connections all(4, 3);
  Pair a1, a2, a3, b1, c1;
  const Seat s1 = seat_of(all, a1, "a"), s2 = seat_of(all, a2, "a"), s3 = seat_of(all, a3, "a"),
             s4 = seat_of(all, b1, "b");
  for (const Seat* seat : {&s1, &s2, &s3, &s4}) (*seat)->works();
  EXPECT_TRUE(s4->waits_for_request(at(0)));
  EXPECT_TRUE(s1->waits_for_request(at(5)));
  EXPECT_TRUE(s2->waits_for_request(at(4)));
  EXPECT_TRUE(s3->waits_for_request(at(6)));
  const Seat s5 = seat_of(all, c1, "c");
  EXPECT_TRUE(a2.is_over());
  EXPECT_FALSE(b1.is_over()) << "although it waits longest: its client has one";
}

TEST(Connections, ThoseAtWorkStayAndTheNewOneIsRefused) {
  Connections all(3, 2);
  Pair a1, a2, b1, more;
  Seat s1 = seat_of(all, a1, "a");
  const Seat s2 = seat_of(all, a2, "a");
  EXPECT_TRUE(s2->waits_for_request(at(1)));
  s1->works(), s2->works();
  const Result<Seat> third = all.enter(more.ours(), "a");
  ASSERT_FALSE(third);
  EXPECT_EQ(third.issue().code, "limit.connections");
  EXPECT_EQ(status_of(third.issue()), 429);
  const Seat s3 = seat_of(all, b1, "b");
  s3->works();
  const Result<Seat> fourth = all.enter(more.ours(), "c");
  ASSERT_FALSE(fourth);
  EXPECT_EQ(fourth.issue().code, "full.connections");
  EXPECT_EQ(status_of(fourth.issue()), 503);
  s1.reset();
  EXPECT_TRUE(all.enter(more.ours(), "a")) << "a seat is free again";
  EXPECT_FALSE(a2.is_over());
}

// The threads of new connections may start late on a busy machine, which must not make the server look full of work.
TEST(Connections, OneThatHasSentNothingYetIsNotAtWork) {
  Connections all(3, 2);
  Pair first, second, third;
  const Seat a = seat_of(all, first, "a"), b = seat_of(all, second, "a"), c = seat_of(all, third, "a");
  EXPECT_TRUE(first.is_over());
  EXPECT_FALSE(second.is_over());
  EXPECT_FALSE(third.is_over());
}

// The thread of the first connection starts after that of the second one: it has waited longer all the same.
TEST(Connections, ANewOneHasWaitedSinceItCameHoweverLateItsThreadSaysSo) {
  Connections all(10, 2);
  Pair first, second, third;
  const Seat a = seat_of(all, first, "a"), b = seat_of(all, second, "a");
  EXPECT_TRUE(b->waits_for_request(now()));
  EXPECT_TRUE(a->waits_for_request(now() + std::chrono::seconds(1)));
  const Seat c = seat_of(all, third, "a");
  EXPECT_TRUE(first.is_over());
  EXPECT_FALSE(second.is_over());
}

TEST(Connections, AtTheEndNobodyIsWaitedFor) {
  Connections all(3, 3);
  Pair waiting, working;
  const Seat s1 = seat_of(all, waiting, "a"), s2 = seat_of(all, working, "a");
  EXPECT_TRUE(s1->waits_for_request(at(0)));
  s2->works();
  all.close();
  EXPECT_TRUE(waiting.is_over());
  EXPECT_FALSE(working.is_over());
  EXPECT_FALSE(s2->waits_for_request(at(1)));
}

TEST(TurnAway, SaysWhyAndWhenToComeBack) {
  Pair pair;
  EXPECT_TRUE(pair.send("GET / HTTP/1.1\r\n\r\n"));
  turn_away(pair.ours(), {"limit.connections", "", "too many"});
  const std::string answer = pair.received();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 429 Too Many Requests\r\n")) << answer;
  EXPECT_NE(answer.find("Retry-After: 1\r\n"), std::string::npos) << answer;
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'"), std::string::npos) << answer;
  EXPECT_TRUE(answer.ends_with(R"({"code":"limit.connections","pointer":"","text":"too many"})")) << answer;
}

// One connection with short time limits: each limit is reached by a client that would wait for ever.
class Waiting : public testing::Test {
 protected:
  static constexpr std::size_t kMostChunked = 1000;
  // Sends a byte each 5 ms until they are refused, for at most 30 s.
  std::thread drip(const std::string& bytes) {
    return std::thread([this, bytes] {
      for (int i = 0; i < 6000 && !stop; ++i) {
        if (!pair.send(bytes.substr(static_cast<std::size_t>(i) % bytes.size(), 1))) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
  }
  std::string read_all() {
    std::string text;
    char block[100];
    for (ssize_t got = 0; (got = connection.read(block, sizeof block)) > 0;)
      text.append(block, static_cast<std::size_t>(got));
    return text;
  }
  Pair pair;
  Connections all{1, 1};
  Seat seat = seat_of(all, pair, "a");
  Connection connection{pair.ours(), *seat, kMostChunked, {0.2, 0.2, 0.2, 1e6, 0.2}};
  std::atomic<bool> stop = false;
};

TEST_F(Waiting, ARequestIsReadToItsEndAndNoFurther) {
  const std::string head = "POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\n";
  EXPECT_TRUE(pair.send("\r\n" + head + "12345GET / HTTP/1.1\r\n\r\n"));
  ASSERT_TRUE(connection.next_request());
  EXPECT_TRUE(connection.has_unread());
  EXPECT_EQ(read_all(), "POST / HTTP/1.1\r\ncontent-length: 5\r\n\r\n12345");
  EXPECT_FALSE(connection.has_unread());
  ASSERT_TRUE(connection.next_request()) << "it was there already";
  EXPECT_EQ(read_all(), "GET / HTTP/1.1\r\n\r\n");
}

TEST_F(Waiting, ABodyWithoutALengthIsNoneUnlessItIsInChunks) {
  EXPECT_TRUE(pair.send("POST / HTTP/1.1\r\n\r\n"));
  ASSERT_TRUE(connection.next_request());
  EXPECT_EQ(read_all(), "POST / HTTP/1.1\r\n\r\n");
  EXPECT_FALSE(connection.has_unread());
  EXPECT_TRUE(pair.send("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n" + std::string(5000, '1')));
  ASSERT_TRUE(connection.next_request());
  EXPECT_EQ(read_all().size(), 17 + 28 + 2 + kMostChunked);
}

TEST_F(Waiting, WhoAsksForNothingIsGivenUpSilently) {
  EXPECT_EQ(connection.next_request().issue().code, "connection.over");
}

TEST_F(Waiting, WhoHangsUpIsGone) {
  EXPECT_TRUE(pair.send("GET / HT"));
  pair.hang_up();
  EXPECT_EQ(connection.next_request().issue().code, "connection.over");
}

TEST_F(Waiting, AHeadThatDripsInIsGivenUp) {
  std::thread client = drip("GET /aaaaaaaaaaaaaaaaaaaaa");
  const Result<Head> head = connection.next_request();
  stop = true;
  client.join();
  ASSERT_FALSE(head);
  EXPECT_EQ(head.issue().code, "call.too_slow");
  EXPECT_EQ(status_of(head.issue()), 408);
}

TEST_F(Waiting, ABodyThatDripsInIsGivenUp) {
  EXPECT_TRUE(pair.send("POST / HTTP/1.1\r\nContent-Length: 100000\r\n\r\n"));
  ASSERT_TRUE(connection.next_request());
  std::thread client = drip("x");
  const std::string read = read_all();
  stop = true;
  client.join();
  EXPECT_LT(read.size(), 5000u);
  EXPECT_TRUE(connection.has_unread());
}

TEST_F(Waiting, AnAnswerThatNobodyTakesIsGivenUp) {
  EXPECT_TRUE(pair.send("GET / HTTP/1.1\r\n\r\n"));
  ASSERT_TRUE(connection.next_request());
  const std::string large(8 << 20, 'x');
  EXPECT_EQ(connection.write(large.data(), large.size()), -1);
}

TEST_F(Waiting, AHeadWithoutAnEndIsRefusedAtItsLimit) {
  std::thread client([this] { EXPECT_TRUE(pair.send("GET / HTTP/1.1\r\nx: " + std::string(kMostHeadBytes, 'y'))); });
  const Result<Head> head = connection.next_request();
  client.join();
  ASSERT_FALSE(head);
  EXPECT_EQ(head.issue().code, "call.long_head");
}

TEST_F(Waiting, WhoMakesRoomIsGoneAtOnce) {
  Pair newer;
  std::thread other([&] {
    for (int i = 0; i < 6000 && !pair.is_over(); ++i) {
      if (const Result<Seat> taken = all.enter(newer.ours(), "a"); taken) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  Connection patient(pair.ours(), *seat, kMostChunked, {600, 600, 600, 1, 600});
  EXPECT_EQ(patient.next_request().issue().code, "connection.over");
  other.join();
}

}  // namespace
}  // namespace contort::server
