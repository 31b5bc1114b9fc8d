#include "cli/verb_tree.h"

namespace skinforge {

void VerbTree::add_cache_verbs() {
  CLI::App* cache = add_group("cache", "Look after the cache");
  add_cache_option(add_verb(cache, "stats", "Count entries, bytes and saved seconds", Verb::CacheStats));
  CLI::App* gc = add_verb(cache, "gc", "Remove what was not asked for longest", Verb::CacheGc);
  add_cache_option(gc);
  gc->add_option("--max-size", line.max_size_gb, "Keep at most so much")
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->type_name("GB")
      ->default_str("any");
  gc->add_option("--max-age", line.max_age_days, "Remove what was not asked for since")
      ->check(CLI::Range(0.0, 1e5).description(""))
      ->type_name("DAYS")
      ->default_str("any");
  CLI::App* pin = add_verb(cache, "pin", "Keep what the last build of recipes made from gc", Verb::CachePin);
  add_recipes(pin);
  add_cache_option(pin);
  CLI::App* unpin = add_verb(cache, "unpin", "Take that back", Verb::CacheUnpin);
  add_recipes(unpin);
  add_cache_option(unpin);
  add_cache_option(
      add_verb(cache, "verify", "Read everything, remove what is damaged (status 4)", Verb::CacheVerify));
  add_cache_option(add_verb(cache, "clear", "Remove every entry", Verb::CacheClear));
  add_cache_option(add_verb(cache, "path", "Print its folder", Verb::CachePath));
}

}  // namespace skinforge
