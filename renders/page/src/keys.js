// Keys of an open case. What the focused element does itself with a key stays its own.

const kOwn = {
  INPUT: (element, key) => element.type === 'checkbox' ? key === ' ' :
    element.type === 'range' ? /^(Arrow|Home|End|Page)/.test(key) : true,
  SELECT: () => true,
  TEXTAREA: () => true,
  BUTTON: (_, key) => key === ' ' || key === 'Enter',
  SUMMARY: (_, key) => key === ' ' || key === 'Enter',
  A: (_, key) => key === 'Enter',
  PRE: (_, key) => /^(Arrow|Home|End|Page| )/.test(key),
};

// table: key -> call. Returns a function that stops listening.
export function listenForKeys(table) {
  const listener = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const own = event.key !== 'Escape' && kOwn[event.target.tagName]?.(event.target, event.key);
    const call = own || !Object.hasOwn(table, event.key) ? null : table[event.key];
    if (!call) return;
    event.preventDefault();
    call(event);
  };
  document.addEventListener('keydown', listener);
  return () => document.removeEventListener('keydown', listener);
}
