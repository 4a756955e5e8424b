// The viewer of one case. The page's script loads this with the first case that is opened; see
// docs/reference/report.md.
import 'uplot/dist/uPlot.min.css';
import './viewer.css';
import { Damaged } from './case_data.js';
import { CaseView } from './case_view.js';

let openView = null;

// Shows the case in the container, in place of what was there.
//   options.frame      frame to start with; the worst one where it is missing
//   options.onFrame    called with each frame that is shown while the motion stands still
//   options.onClose    called when the reader goes back to the list
//   options.onPrevious, options.onNext   where there is such a case
//   options.position   "2 of 14"
//   options.command    replay command; options.picture: {src, alt} of the film strip
//   options.stripViews   where there is a strip: asks for from where it is seen (strip_view.js)
// Throws an Error with a sentence for the reader where the data cannot be shown.
export function open(container, data, options = {}) {
  close();
  try {
    const onClose = () => { openView = null; options.onClose?.(); };
    openView = new CaseView(container, data, { ...options, onClose });
  } catch (error) {
    openView = null;
    throw error instanceof Damaged ? new Error(error.message) : error;
  }
  return openView;
}

// Takes the open case away, without calling onClose.
export function close() {
  openView?.dispose();
  openView = null;
}
