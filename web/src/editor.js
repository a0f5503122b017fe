// SPDX-License-Identifier: BSD-3-Clause
// The text editor for scripts in Python and Lua: CodeMirror with the functions of sim.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, snippetCompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import {
  HighlightStyle,
  StreamLanguage,
  bracketMatching,
  foldGutter,
  foldKeymap,
  indentOnInput,
  indentUnit,
  syntaxHighlighting,
} from "@codemirror/language";
import { lua } from "@codemirror/legacy-modes/mode/lua";
import { forceLinting, lintGutter, lintKeymap, linter } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, StateEffect } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightActiveLineGutter,
  hoverTooltip,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

const colours = HighlightStyle.define([
  { tag: [tags.keyword, tags.operatorKeyword, tags.controlKeyword], color: "var(--code-keyword)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--code-string)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--code-number)" },
  { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
  { tag: [tags.function(tags.variableName), tags.function(tags.propertyName)], color: "var(--code-function)" },
  { tag: [tags.definition(tags.variableName), tags.className], color: "var(--code-function)" },
  { tag: tags.self, color: "var(--code-keyword)" },
]);

const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", backgroundColor: "var(--panel)", color: "var(--text)" },
  ".cm-scroller": { fontFamily: '"DejaVu Sans Mono", monospace', lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--faint)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--accent) 9%, transparent)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--accent-back) !important" },
  ".cm-tooltip": { backgroundColor: "var(--raised)", border: "1px solid var(--line)", borderRadius: "5px" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": { backgroundColor: "var(--accent-back)", color: "var(--text)" },
  ".cm-completionInfo": { maxWidth: "34em", padding: "6px 10px" },
  ".cm-completionDetail": { color: "var(--faint)", fontStyle: "normal" },
  ".cm-panels": { backgroundColor: "var(--raised)", color: "var(--text)" },
  ".cm-matchingBracket": { backgroundColor: "var(--accent-back)", outline: "none" },
});

const problemsChanged = StateEffect.define();

/// One text at a time. `calls` has changed(), save(), signature(text or null) and check(text), which resolves to errors
/// with line and text.
export class Editor {
  #view;
  #calls;
  #byName = new Map(); // "sim.getObject": { call, text, differs }, with old names and callbacks
  #api;
  #language = new Compartment();
  #name = "python";
  #problems = []; // of the script that runs, until the text changes

  constructor(parent, api, calls) {
    this.#api = api;
    this.#calls = calls;
    for (const [module, functions] of Object.entries(api.functions)) {
      for (const each of functions) this.#byName.set(`${module}.${each.name}`, each);
    }
    for (const [name, text] of Object.entries(api.callbacks)) this.#byName.set(name, { call: name, text });
    for (const [old, present] of Object.entries(api.old)) {
      const known = this.#byName.get(present);
      if (known) this.#byName.set(old, { ...known, old });
    }
    this.#view = new EditorView({ parent, state: this.#state("", "python") });
  }

  text() {
    return this.#view.state.doc.toString();
  }

  open(text, language) {
    this.#name = language;
    this.#problems = [];
    this.#view.setState(this.#state(text, language));
    this.#calls.signature(null);
  }

  /// Shows a newer text of the same file. What did not change at its begin and end stays where it is, with the cursor.
  replace(text) {
    const before = this.text();
    const shorter = Math.min(before.length, text.length);
    let from = 0;
    while (from < shorter && before[from] === text[from]) ++from;
    let equal = 0;
    while (equal < shorter - from && before.at(-1 - equal) === text.at(-1 - equal)) ++equal;
    const changes = { from, to: before.length - equal, insert: text.slice(from, text.length - equal) };
    this.#view.dispatch({ changes });
  }

  goTo(line) {
    const { doc } = this.#view.state;
    const { from } = doc.line(Math.min(Math.max(line, 1), doc.lines));
    this.#view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
    this.#view.focus();
  }

  /// Shows errors of the script that runs: { line, text, level }.
  showProblems(problems) {
    this.#problems = problems;
    this.#view.dispatch({ effects: problemsChanged.of(null) });
    forceLinting(this.#view);
  }

  #state(text, language) {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(),
        foldGutter(),
        lintGutter(),
        history(),
        drawSelection(),
        indentOnInput(),
        indentUnit.of("    "),
        bracketMatching(),
        closeBrackets(),
        highlightActiveLine(),
        highlightActiveLineGutter(),
        highlightSelectionMatches(),
        search({ top: true }),
        syntaxHighlighting(colours),
        theme,
        this.#language.of(language === "lua" ? StreamLanguage.define(lua) : python()),
        autocompletion({ override: [(context) => this.#complete(context)], icons: false }),
        hoverTooltip((view, position) => this.#hover(view, position)),
        linter((view) => this.#lint(view), {
          delay: 600,
          needsRefresh: ({ transactions }) => transactions.some(({ effects }) => effects.some((e) => e.is(problemsChanged))),
        }),
        keymap.of([
          { key: "Mod-s", preventDefault: true, run: () => (this.#calls.save(), true) },
          indentWithTab,
          ...closeBracketsKeymap,
          ...searchKeymap,
          ...historyKeymap,
          ...foldKeymap,
          ...completionKeymap,
          ...lintKeymap,
          ...defaultKeymap,
        ]),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) {
            this.#problems = [];
            this.#calls.changed();
          }
          if (update.docChanged || update.selectionSet) this.#calls.signature(this.#enclosing(update.state));
        }),
        EditorView.domEventHandlers({ keydown: (event) => void event.stopPropagation() }),
      ],
    });
  }

  #complete(context) {
    if (context.tokenBefore(["Comment", "comment"])) return null; // as the grammars of Python and Lua name it
    const named = context.matchBefore(/\bsim\w*\.\w*/);
    if (named && named.text.split(".")[0] in this.#api.functions) {
      const [module] = named.text.split(".");
      const functions = (this.#api.functions[module] ?? []).map((each) => ({
        label: each.name,
        type: "function",
        detail: each.call.slice(module.length + 1 + each.name.length),
        info: [each.text, each.differs].filter(Boolean).join(" "),
        apply: `${each.name}(`,
        boost: 1,
      }));
      const constants = module === "sim" ? this.#api.constants.map((label) => ({ label, type: "constant" })) : [];
      return { from: named.from + module.length + 1, options: [...functions, ...constants], validFor: /^\w*$/ };
    }
    const word = context.matchBefore(/\w+/);
    if (!word && !context.explicit) return null;
    const lua = this.#name === "lua";
    const callbacks = Object.entries(this.#api.callbacks).map(([label, info]) =>
      snippetCompletion(lua ? `function ${label}()\n\t\${}\nend` : `def ${label}():\n\t\${}`, { label, info, type: "callback" }),
    );
    const modules = Object.keys(this.#api.functions).map((label) => ({ label, type: "module" }));
    const seen = new Set(this.text().match(/\b[A-Za-z_]\w{3,}\b/g) ?? []);
    const words = [...seen].filter((each) => each !== word?.text).map((label) => ({ label, type: "text", boost: -5 }));
    return { from: word ? word.from : context.pos, options: [...modules, ...callbacks, ...words], validFor: /^\w*$/ };
  }

  /// The call of the function whose arguments hold the cursor.
  #enclosing(state) {
    const { head } = state.selection.main;
    const before = state.sliceDoc(Math.max(0, head - 2000), head);
    let depth = 0;
    for (let i = before.length - 1; i >= 0; --i) {
      if (")]}".includes(before[i])) ++depth;
      else if ("([{".includes(before[i])) {
        if (depth) --depth;
        else if (before[i] === "(") {
          const found = /\b(sim\w*\.\w+)$/.exec(before.slice(0, i));
          return found ? (this.#byName.get(found[1])?.call ?? null) : null;
        }
      }
    }
    return null;
  }

  #hover(view, position) {
    const { from, text } = view.state.doc.lineAt(position);
    for (const found of text.matchAll(/\b(?:sim\w*\.\w+|sim[A-Z]\w*|sysCall_\w+)/g)) {
      const begin = from + found.index;
      if (position < begin || position > begin + found[0].length) continue;
      const known = this.#byName.get(found[0]);
      if (!known) return null;
      return {
        pos: begin,
        end: begin + found[0].length,
        create: () => {
          const dom = document.createElement("div");
          dom.className = "cm-completionInfo";
          const call = document.createElement("code");
          call.textContent = known.call;
          dom.append(call);
          for (const words of [known.old && `${known.old} is an old name.`, known.text, known.differs]) {
            if (!words) continue;
            const paragraph = document.createElement("p");
            paragraph.textContent = words;
            dom.append(paragraph);
          }
          return { dom };
        },
      };
    }
    return null;
  }

  async #lint(view) {
    const { doc } = view.state;
    const errors = await this.#calls.check(doc.toString()).catch(() => []);
    const all = [...errors.map((each) => ({ level: "error", ...each })), ...this.#problems];
    return all.map(({ line, text, level }) => {
      const { from, to } = doc.line(Math.min(Math.max(line, 1), doc.lines));
      return { from, to, severity: level, message: text };
    });
  }
}

