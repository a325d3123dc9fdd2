#include "base/base64.hpp"

#include <string>

#include <catch2/catch.hpp>

using springlod::base64;

TEST_CASE("base64 of the samples of RFC 4648") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("base64 of bytes that are not text") {
  CHECK(base64(std::string("\x00\xff\xfe", 3)) == "AP/+");
  CHECK(base64(std::string("\xfb\xef\xbe", 3)) == "++++");
}
