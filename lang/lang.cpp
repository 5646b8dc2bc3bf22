// SPDX-License-Identifier: Apache-2.0
// Entry point: connects the parts for one scene.
#include "lang/lang.h"

#include "lang/directives.h"
#include "lang/hash.h"
#include "lang/predefined.h"
#include "lang/text_store.h"

#include <new>

namespace vestige::lang {
namespace {

/// All parts of one run; references between them stay valid during its lifetime.
class Reader {
 public:
  Reader(const std::string& name, const SchemaSource& schemas, const Options& options,
         Sources& sources, Result& result)
      : context_(options, sources, result.diagnostics, result.edits),
        words_(schemas),
        stream_(context_),
        parser_(context_, stream_, words_),
        includes_(context_, name),
        dataFiles_(context_, includes_),
        directives_(context_, stream_, parser_, includes_, dataFiles_),
        result_(result) {
    stream_.onDirective = [this](const Token& t) { directives_.obey(t); };
    stream_.onMacro = [this](const Token& t) { directives_.expand(t); };
    context_.fileExists = [this](const std::string& file) {
      if (dataFiles_.exists(file)) return true;
      std::vector<std::string> tried;
      const std::string path = includes_.find(file, 0, tried);
      return !path.empty() && includes_.isAllowed(path);
    };
    context_.placeBehind = [this](Symbol& whole) { return directives_.place(whole); };
    predefine(context_, words_, name);
    context_.declaredIn = [this](const std::string& name) { return includes_.declaredIn(name); };
  }

  void read(const std::string& name, const std::string& text) {
    try {
      push(includes_.add(name, text));
      const auto& definitions = context_.options.definitions;
      for (auto d = definitions.rbegin(); d != definitions.rend(); ++d)
        push(includes_.add(kDefinition + d->first,
                           "#declare " + d->first + " = " + d->second + ";"));
      parser_.scene(result_.scene);
    } catch (const Stop&) {
    } catch (const std::bad_alloc&) {
      result_.diagnostics.error({}, "not enough memory to read this scene");
    }
    try {
      dataFiles_.closeAll();
    } catch (const Stop&) {
    }
  }

 private:
  void push(const Includes::File& f) {
    const auto end = std::uint32_t(f.tokens->tokens.size() - 1);
    stream_.push({Frame::Kind::file, f.tokens, 0, end, -1, f.file});
  }

  Context context_;
  Vocabulary words_;
  TokenStream stream_;
  Parser parser_;
  Includes includes_;
  DataFiles dataFiles_;
  Directives directives_;
  Result& result_;
};

}  // namespace

Result readSceneText(const std::string& name, const std::string& text, const SchemaSource& schemas,
                     const Options& options) {
  Result result;
  const auto sources = std::make_shared<Sources>();
  Reader(name, schemas, options, *sources, result).read(name, text);
  for (int i = 0; i < sources->size(); ++i) result.scene.files.push_back(sources->text(i).name);
  result.scene.hash = hashOf(result.scene);
  result.sources = sources;
  return result;
}

Result readScene(const std::string& file, const SchemaSource& schemas, const Options& options) {
  std::string why;
  const auto text = readText(options, file, std::uintmax_t(options.limits.memory), why);
  if (text) return readSceneText(file, *text, schemas, options);
  Result result;
  result.diagnostics.error({}, "the scene '" + file + "' " + why);
  result.sources = std::make_shared<Sources>();
  return result;
}

}  // namespace vestige::lang
