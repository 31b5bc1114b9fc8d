// The 3D view of a report: what the page (src/html/page) loads as a module.
export { ModelView } from './model_view.js';
